// SPDX-License-Identifier: MIT
// What a field is shown for. A text that was typed for one motion must not stay in the field, and so be written to another one.

import type { EditorState } from '../../model/editor-state.ts';

type Shown = Pick<EditorState, 'page' | 'step'> & { readonly document: Pick<EditorState['document'], 'name'> };

export class ShownFor {
    private motion = '';
    private step = -1;

    /** Another motion is chosen than at the last call, or one of another document. Documents have different names. */
    isOther({ page, step, document }: Shown): boolean {
        const motion = `${page} ${document.name}`;
        const isOther = motion !== this.motion;
        [this.motion, this.step] = [motion, step];
        return isOther;
    }

    /** As isOther(), or another step of the same motion. */
    isOtherStep(shown: Shown): boolean {
        const { step } = this;
        return this.isOther(shown) || step !== shown.step;
    }
}

/** Whether a field of a motion has a text that a person has typed for that motion and not committed yet. */
export class TypedFor {
    private readonly shownFor = new ShownFor();
    private isTyped = false;

    type(): void {
        this.isTyped = true;
    }

    /** At each rendering. Another motion ends it: the field is then to show that one's. */
    isHalfTyped(shown: Shown): boolean {
        if (this.shownFor.isOther(shown)) this.isTyped = false;
        return this.isTyped;
    }

    /** true: there is something to commit, which is committed now. */
    take(): boolean {
        const isTyped = this.isTyped;
        this.isTyped = false;
        return isTyped;
    }
}
