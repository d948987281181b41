// SPDX-License-Identifier: MIT
// When a robot answers, it is asked for its pages and stands up. A restart in between is no error.
import { expect, test, vi } from 'vitest';
import { Arrival } from '../app/arrival.ts';
import { RobotError } from '../robot/robot-error.ts';
import type { SessionState } from '../view/session/session.ts';
import { Store } from '../view/store.ts';

test.each([
    ['not-connected', 0],
    ['no-answer', 2],
] as const)('asked in vain, %s: told %i times', async (code, times) => {
    const fail = vi.fn();
    const inVain = () => Promise.reject(new RobotError(code));
    const nothing = (): void => undefined;
    const arrival = new Arrival({
        state: new Store({} as SessionState),
        messages: { fail },
        status: { tell: nothing, look: nothing, ask: nothing },
        sources: {
            isSimulated: true,
            connection: { version: { image: 'play' }, requests: { ask: inVain } },
            simulated: { prepare: inVain },
        },
        editor: { state: new Store({ robot: [] }) },
    } as unknown as ConstructorParameters<typeof Arrival>[0]);
    arrival.connectionChanged('ready');
    await vi.waitFor(() => expect(fail).toHaveBeenCalledTimes(times));
    await new Promise(resolve => setTimeout(resolve));
    expect(fail).toHaveBeenCalledTimes(times);
});
