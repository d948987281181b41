// SPDX-License-Identifier: MIT

import { RobotError } from '../robot/robot-error.ts';
import type { Store } from '../view/store.ts';

/** Resolves once isOver returns true, for the present state or a later one. Rejects with what it throws, and with no-answer after limitMs. */
export function until<T extends object>(store: Store<T>, isOver: (state: T) => boolean, limitMs?: number): Promise<void> {
    return new Promise((resolve, reject) => {
        let unwatch = (): void => undefined;
        let timer: ReturnType<typeof setTimeout> | undefined;
        const end = (action: () => void): void => {
            clearTimeout(timer);
            queueMicrotask(() => unwatch()); // the store may call before it has returned unwatch
            action();
        };
        if (limitMs !== undefined) timer = setTimeout(() => end(() => reject(new RobotError('no-answer'))), limitMs);
        unwatch = store.watch(state => {
            try {
                if (isOver(state)) end(resolve);
            } catch (error) {
                end(() => reject(error as Error));
            }
        });
    });
}
