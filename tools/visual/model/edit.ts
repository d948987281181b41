// SPDX-License-Identifier: MIT
// All edits of a document, bound to the page format. Each takes a document and returns the changes as a value, or the reason why it is
// refused. The document stays unchanged.

import type { PageFormat } from './page-format.ts';
import * as pages from './page-edits.ts';
import * as steps from './step-edits.ts';

type Bound<F> = F extends (format: PageFormat, ...rest: infer Rest) => infer Made ? (...rest: Rest) => Made : never;

/** Binds the first argument. */
function bind<Rest extends readonly unknown[], Made>(
    format: PageFormat,
    edit: (format: PageFormat, ...rest: Rest) => Made,
): (...rest: Rest) => Made {
    return (...rest) => edit(format, ...rest);
}

export interface Edits {
    readonly setJoints: Bound<typeof steps.setJoints>;
    readonly insertSteps: Bound<typeof steps.insertSteps>;
    readonly deleteSteps: Bound<typeof steps.deleteSteps>;
    readonly duplicateSteps: Bound<typeof steps.duplicateSteps>;
    readonly moveSteps: Bound<typeof steps.moveSteps>;
    readonly setTime: Bound<typeof steps.setTime>;
    readonly setPause: Bound<typeof steps.setPause>;
    readonly mirrorSteps: Bound<typeof steps.mirrorSteps>;
    readonly exchangeSteps: Bound<typeof steps.exchangeSteps>;
    readonly interpolate: Bound<typeof steps.interpolate>;
    readonly rename: Bound<typeof pages.rename>;
    readonly setHeader: Bound<typeof pages.setHeader>;
    readonly setLink: Bound<typeof pages.setLink>;
    readonly copyPage: Bound<typeof pages.copyPage>;
    readonly movePage: Bound<typeof pages.movePage>;
    readonly swapPages: Bound<typeof pages.swapPages>;
    readonly clearPages: Bound<typeof pages.clearPages>;
    readonly replacePages: Bound<typeof pages.replacePages>;
    readonly adoptPages: Bound<typeof pages.adoptPages>;
    readonly copyForEditing: Bound<typeof pages.copyForEditing>;
}

export function makeEdits(format: PageFormat): Edits {
    return {
        setJoints: bind(format, steps.setJoints),
        insertSteps: bind(format, steps.insertSteps),
        deleteSteps: bind(format, steps.deleteSteps),
        duplicateSteps: bind(format, steps.duplicateSteps),
        moveSteps: bind(format, steps.moveSteps),
        setTime: bind(format, steps.setTime),
        setPause: bind(format, steps.setPause),
        mirrorSteps: bind(format, steps.mirrorSteps),
        exchangeSteps: bind(format, steps.exchangeSteps),
        interpolate: bind(format, steps.interpolate),
        rename: bind(format, pages.rename),
        setHeader: bind(format, pages.setHeader),
        setLink: bind(format, pages.setLink),
        copyPage: bind(format, pages.copyPage),
        movePage: bind(format, pages.movePage),
        swapPages: bind(format, pages.swapPages),
        clearPages: bind(format, pages.clearPages),
        replacePages: bind(format, pages.replacePages),
        adoptPages: bind(format, pages.adoptPages),
        copyForEditing: bind(format, pages.copyForEditing),
    };
}
