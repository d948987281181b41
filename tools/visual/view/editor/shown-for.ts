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
