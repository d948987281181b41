// SPDX-License-Identifier: MIT
// Makes DOM elements in one expression. Text goes in as text, never as HTML.

type Child = Node | string | null;
type Attributes = Readonly<Record<string, string | number | boolean | ((event: Event) => void)>>;

/** `onclick` and the like are listeners; true sets an attribute, false leaves it out. */
export function make<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    attributes: Attributes = {},
    ...children: Child[]
): HTMLElementTagNameMap[K] {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === 'function') element.addEventListener(name.replace(/^on/, ''), value);
        else if (value !== false) element.setAttribute(name, value === true ? '' : String(value));
    }
    element.append(...children.filter(child => child !== null));
    return element;
}

/** Do letters go into what has the keyboard? */
export function isTyping(event: KeyboardEvent): boolean {
    const NOT_TEXT = '[type="range"], [type="checkbox"], [type="radio"]';
    return event.target instanceof Element && event.target.closest(`input:not(${NOT_TEXT}), textarea, terminal-pane`) !== null;
}

/** What stands on an element, for those who do not see it. */
function nameOf(element: Element): string {
    return element.getAttribute('aria-label') ?? element.textContent;
}

/** Renders what stands in `root` anew. Whoever was at something in there with the keyboard is at what is called the same again. */
export function keepFocus(root: Element, render: () => void): void {
    const { activeElement } = document;
    const name = activeElement && root.contains(activeElement) ? nameOf(activeElement) : null;
    render();
    if (name === null) return;
    const all = root.querySelectorAll<HTMLElement>('button, select, input');
    [...all].find(element => nameOf(element) === name)?.focus({ preventScroll: true });
}

/** Takes away something, or its use. Whoever was there with the keyboard is at the other one. */
export function handOver(from: Element, to: HTMLElement | null, take: () => void): void {
    const hadFocus = from.contains(document.activeElement);
    take();
    if (hadFocus) to?.focus({ preventScroll: true });
}

/** Where somebody is who has put away what stood over the picture. */
export function pictureCanvas(): HTMLElement | null {
    return document.querySelector<HTMLElement>('robot-view canvas');
}

/** Writes a text, unless it stands there already: written again it would be laid out again. */
export function setText(element: Element, text: string): void {
    if (element.textContent !== text) element.textContent = text;
}

/** A menu that Escape and a press beside it close. The returned function ends that. */
export function closesByItself(menu: HTMLElement & { open: boolean }): () => void {
    const press = (event: Event): void => {
        if (menu.open && event.target instanceof Node && !menu.contains(event.target)) menu.open = false;
    };
    const keyDown = (event: KeyboardEvent): void => {
        if (event.key !== 'Escape' || !menu.open || document.querySelector('dialog[open]')) return;
        event.preventDefault();
        menu.open = false;
        menu.querySelector<HTMLElement>('summary, [aria-expanded]')?.focus();
    };
    document.addEventListener('pointerdown', press, { capture: true });
    document.addEventListener('keydown', keyDown);
    return () => {
        document.removeEventListener('pointerdown', press, { capture: true });
        document.removeEventListener('keydown', keyDown);
    };
}

/** A custom element of ours, made with what it works on. */
export function define(name: string, element: CustomElementConstructor): void {
    if (!customElements.get(name)) customElements.define(name, element);
}
