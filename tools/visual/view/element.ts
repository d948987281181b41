// SPDX-License-Identifier: MIT
// Helpers for DOM elements: make them, keep the focus, close menus. Text is inserted as text, never as HTML.

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

/** The focused element accepts letters. */
export function isTyping(event: KeyboardEvent): boolean {
    const NOT_TEXT = '[type="range"], [type="checkbox"], [type="radio"]';
    return event.target instanceof Element && event.target.closest(`input:not(${NOT_TEXT}), textarea, terminal-pane`) !== null;
}

/** The accessible name. */
function nameOf(element: Element): string {
    return element.getAttribute('aria-label') ?? element.textContent;
}

/** On this element the browser shows no menu. On macOS and Linux a menu takes the release of a button that is held, also that of Ctrl and a
 *  click, so what is dragged or held would stay so. */
export function withoutMenu(element: Element): void {
    element.addEventListener('contextmenu', event => event.preventDefault());
}

/** For a button that plays a motion: ignores the second click of a double click, or the robot would refuse it as busy. */
export function once(action: () => unknown): (event: Event) => void {
    return event => {
        const isSecondClick = 'detail' in event && typeof event.detail === 'number' && event.detail > 1;
        if (!isSecondClick) action();
    };
}

/** Renders the contents of `root` again. If the focus was in there, it moves to the new element of the same name. */
export function keepFocus(root: Element, render: () => void): void {
    const { activeElement } = document;
    const name = activeElement && root.contains(activeElement) ? nameOf(activeElement) : null;
    render();
    if (name === null) return;
    const all = root.querySelectorAll<HTMLElement>('button, select, input');
    [...all].find(element => nameOf(element) === name)?.focus({ preventScroll: true });
}

/** take() removes or disables `from`. If the focus was in `from`, it moves to `to`. */
export function handOver(from: Element, to: HTMLElement | null, take: () => void): void {
    const hadFocus = from.contains(document.activeElement);
    take();
    if (hadFocus) to?.focus({ preventScroll: true });
}

/** Switches a control off or on. If it had the focus, a neighbour gets it: otherwise keyboard and screen reader would be nowhere. */
export function setDisabled(control: HTMLButtonElement | HTMLInputElement, isDisabled: boolean): void {
    const to = isDisabled && control === document.activeElement ? neighbourOf(control) : null;
    handOver(control, to, () => {
        control.disabled = isDisabled;
    });
}

/** The control before it in its row, or else behind it; if there is none, around the row. */
function neighbourOf(control: Element): HTMLElement | null {
    for (let box = control.parentElement; box; box = box.parentElement) {
        const all = [...box.querySelectorAll<HTMLElement>('button, select, input')];
        const useful = all.filter(one => one === control || (one.matches(':enabled') && one.checkVisibility()));
        const at = useful.indexOf(control as HTMLElement);
        const next = useful[at - 1] ?? useful[at + 1];
        if (next) return next;
    }
    return null;
}

/** Gets the focus when something over the picture is closed. null: there is no picture. */
export function pictureCanvas(): HTMLElement | null {
    return document.querySelector<HTMLElement>('robot-view canvas');
}

/** Sets a text only if it differs: setting the same text again would cause another layout. */
export function setText(element: Element, text: string): void {
    if (element.textContent !== text) element.textContent = text;
}

/** Closes a menu on Escape and on a press outside it. The returned function removes the listeners. */
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

/** Registers a custom element, unless the name is registered already. */
export function define(name: string, element: CustomElementConstructor): void {
    if (!customElements.get(name)) customElements.define(name, element);
}
