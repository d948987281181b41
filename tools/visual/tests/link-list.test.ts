// SPDX-License-Identifier: MIT
// The list of a motion's links: what is chosen in it is where the motion leads.
import { expect, test, vi } from 'vitest';
import { DocumentEditor } from '../app/editor.ts';
import type { Body } from '../model/body.ts';
import { pageOf, withChanges } from '../model/document.ts';
import { linkList } from '../view/editor/link-list.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { libraryDocument, makeFormat, makeMotion } from './motion-bench.ts';

interface Made {
    readonly tag: string;
    readonly attributes: Readonly<Record<string, unknown>>;
    readonly children: readonly (Made | string)[];
}

vi.mock('../view/element.ts', () => ({
    make: (tag: string, attributes: Made['attributes'] = {}, ...children: Made['children']): Made => ({ tag, attributes, children }),
}));
vi.mock('../view/choice.ts', () => ({ onChoice: vi.fn() }));

const { format } = await makeFormat();
const library = await libraryDocument();
const player = await makeMotion();

function found(tree: readonly (Made | string)[], name: string): Made[] {
    return tree.flatMap(made =>
        typeof made === 'string' ? [] : [...(made.attributes['aria-label'] === name ? [made] : []), ...found(made.children, name)],
    );
}

test.each([
    [0, 'none', false],
    [2, '2 bow', true],
    [200, '200, not in the document', false],
])('next %i is shown as "%s"; only a page of the document can be gone to', (next, shown, mayGo) => {
    const before = pageOf(library, 3);
    const after = format.sealed(before.with(format.layout.atNext, next));
    const document = withChanges(library, [{ page: 3, before, after }]);
    const events = { changed: vi.fn(), refused: vi.fn(), opened: vi.fn() };
    const editor = new DocumentEditor({ joints: [] } as unknown as Body, { format, player, document }, events);
    const list = linkList(editor, { nodes: [], links: [] }, 3) as unknown as Made[];
    const [choice] = found(list, TEXTS.links.names.next);
    const chosen = choice?.children.filter(option => typeof option !== 'string' && option.attributes.selected);
    expect(chosen).toMatchObject([{ attributes: { value: next }, children: [shown] }]);
    expect(found(list, TEXTS.links.show(TEXTS.links.names.next))).toMatchObject([{ attributes: { disabled: !mayGo } }]);
});
