// SPDX-License-Identifier: MIT
// The cost of one frame of a dragged way-point in the page's thread, with seven steps of 31 joints: the edit and everything that watches
// it, the curve from motion.wasm, and the strokes. Medians of 100 frames.
import type { Editor } from '../../view/session/editor.ts';
import { PageServer, Visitor, startBrowser } from '../page/page-bench.ts';

/** Members used here that are private in TypeScript. */
interface Pane {
    readonly session: { readonly editor: Editor };
    makeScene(): unknown;
    draw(): void;
}

interface Frames {
    readonly edit: number[];
    readonly curve: number[];
    readonly strokes: number[];
}

const FRAMES = 100;
const [browser, server] = await Promise.all([startBrowser(), PageServer.start()]);
const visitor = await Visitor.come(browser, server.address, { screen: { width: 1280, height: 800 } });
await visitor.untilStanding();
await visitor.open('Robot');
await visitor.button('Pause').click(); // the robot's own work is not measured
await visitor.open('Curves');
const frames = await visitor.page.locator('curve-canvas').evaluate(async (element, count): Promise<Frames> => {
    const pane = element as unknown as Pane;
    const { editor } = pane.session;
    const page = 3;
    editor.select({ page });
    const all = new Map(Array.from({ length: 31 }, (_, id) => [id, 500 + id]));
    editor.dispatch(editor.edits.setJoints(editor.state.get().document, page, [0, 1, 2, 3, 4, 5, 6], all));
    editor.select({ joints: new Set(all.keys()) });
    await new Promise(resolve => setTimeout(resolve, 1000));
    const gesture = editor.gesture('drag');
    const made: Frames = { edit: [], curve: [], strokes: [] };
    for (let i = 0; i < count; i++) {
        const start = performance.now();
        gesture.change(editor.edits.setJoints(gesture.start, page, [3], new Map([[5, 400 + i]])));
        const edited = performance.now();
        pane.makeScene();
        const scened = performance.now();
        pane.draw();
        const drawn = performance.now();
        made.edit.push(edited - start);
        made.curve.push(scened - edited);
        made.strokes.push(drawn - scened - (scened - edited)); // draw() makes the scene again
        await new Promise(resolve => requestAnimationFrame(resolve));
    }
    gesture.cancel();
    return made;
}, FRAMES);
const median = (values: readonly number[]): number => [...values].sort((a, b) => a - b)[values.length >> 1] ?? 0;
for (const [name, values] of Object.entries(frames))
    console.log(
        `curve dragged, 31 joints, ${name.padEnd(8)} ${median(values as number[])
            .toFixed(1)
            .padStart(6)} ms a frame`,
    );
await browser.close();
await server.stop();
