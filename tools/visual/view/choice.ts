// SPDX-License-Identifier: MIT
// A list whose choice triggers an action. A choice by mouse acts at once. By keyboard, arrows and letters pass unwanted entries, so Enter
// acts; Escape or leaving the list reverts the choice.

/** action: gets the chosen value; it may set another one. */
export function onChoice(list: HTMLSelectElement, action: (value: string) => unknown): void {
    let isKeyDown = false;
    let before: string | null = null; // value before a pending choice by keyboard
    const act = (): void => {
        before = null;
        action(list.value);
    };
    const takeBack = (): void => {
        isKeyDown = false;
        if (before !== null) list.value = before;
        before = null;
    };
    let atKey = list.value;
    list.addEventListener('keydown', event => {
        if (event.key === 'Enter' && before !== null) {
            event.preventDefault(); // it would open the list
            act();
        } else if (event.key === 'Escape' && before !== null) {
            event.preventDefault(); // it would close the dialog around it
            takeBack();
        } else {
            isKeyDown = !opensList(event);
            if (before === null) atKey = list.value;
        }
    });
    list.addEventListener('keyup', () => (isKeyDown = false));
    list.addEventListener('blur', takeBack);
    list.addEventListener('change', () => {
        if (isKeyDown) before ??= atKey;
        else act();
    });
}

/** In an open list the arrows only move a highlight, and Enter chooses. */
function opensList(event: KeyboardEvent): boolean {
    return event.key === ' ' || event.key === 'Enter' || event.key === 'F4' || event.altKey;
}
