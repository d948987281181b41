// SPDX-License-Identifier: MIT
// A field that the person has typed into and not left yet. The browser reports its text (`change`) only when the person leaves the field,
// which does not happen when the page is left, or when a link chooses another motion.

const FIELDS = 'input[type=text], input[type=number]';

/** Returns a function that commits the half-typed field as if the person had left it. A field without new text is not touched: its owner
 *  would write what it shows, for example the time of one step to all chosen ones. */
export function watchTyping(root: Document): () => void {
    let typed: EventTarget | null = null;
    const forget = ({ target }: Event): void => {
        if (target === typed) typed = null;
    };
    root.addEventListener('input', ({ target }) => (typed = target), { capture: true });
    root.addEventListener('change', forget, { capture: true });
    root.addEventListener('blur', forget, { capture: true });
    return () => {
        const field = root.activeElement;
        if (field && field === typed && field.matches(FIELDS)) field.dispatchEvent(new Event('change'));
    };
}
