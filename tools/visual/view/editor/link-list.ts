// SPDX-License-Identifier: MIT
// The links of one page as a list: targets to choose or to go to, and the pages that lead here.

import { PAGE_COUNT } from '../../model/motion.ts';
import { LINK_FIELDS, PARTNER_FIELDS } from '../../model/page.ts';
import type { LinkField } from '../../model/page.ts';
import type { LinkGraph } from '../../model/links.ts';
import { REMOTE_BUTTONS, wordOf } from '../../robot/remote.ts';
import type { RemoteButton } from '../../robot/remote.ts';
import type { Editor } from '../session/editor.ts';
import { onChoice } from '../choice.ts';
import { make } from '../element.ts';
import { codeText, titleOf } from '../texts/editor.ts';
import { TEXTS } from '../texts/texts.ts';

const CODE_OF: Partial<Record<LinkField, 'linked1Code' | 'linked2Code'>> = { linked1: 'linked1Code', linked2: 'linked2Code' };
/** Choices: no key, each button alone, and the diagonal directions. */
const CHORDS: readonly (readonly RemoteButton[])[] = [
    [],
    ...(Object.keys(REMOTE_BUTTONS) as RemoteButton[]).map(button => [button]),
    ...(['up', 'down'] as const).flatMap(
        way =>
            [
                [way, 'left'],
                [way, 'right'],
            ] as const,
    ),
];

export function linkList(editor: Editor, graph: LinkGraph, page: number): HTMLElement[] {
    const incoming = graph.links.filter(link => link.to === page && link.from !== page);
    return [
        make('h2', {}, TEXTS.links.of(titleOf(editor, page))),
        make('div', { class: 'fields' }, ...[...LINK_FIELDS, ...PARTNER_FIELDS].flatMap(link => field(editor, page, link))),
        make('h2', {}, TEXTS.links.leadsHere),
        incoming.length === 0
            ? make('p', { class: 'none' }, TEXTS.links.noneLeads)
            : make(
                  'ul',
                  {},
                  ...incoming.map(link =>
                      make(
                          'li',
                          {},
                          make(
                              'button',
                              { onclick: () => editor.select({ page: link.from }) },
                              TEXTS.links.leads(titleOf(editor, link.from), TEXTS.links.names[link.kind], codeText(link.code)),
                          ),
                      ),
                  ),
              ),
    ];
}

function field(editor: Editor, page: number, link: LinkField): HTMLElement[] {
    const view = editor.page(page);
    const target = view[link];
    const choice = make(
        'select',
        { 'aria-label': TEXTS.links.names[link] },
        ...targets(editor, target).map(([value, title]) => make('option', { value, selected: value === target }, title)),
    );
    onChoice(choice, to => editor.dispatch(editor.edits.setLink(editor.state.get().document, page, link, Number(to))));
    const go = make(
        'button',
        {
            disabled: target === 0 || target >= PAGE_COUNT,
            'aria-label': TEXTS.links.show(TEXTS.links.names[link]),
            onclick: () => editor.select({ page: target }),
        },
        TEXTS.page.show,
    );
    const code = CODE_OF[link];
    return [make('label', {}, TEXTS.links.names[link]), choice, ...(code ? [codeField(editor, page, link, code)] : []), go];
}

/** Possible targets. Empty pages come last: they may be filled later. A robot with 256 pages may link to one that the document lacks. */
function targets(editor: Editor, now: number): [number, string][] {
    const { document } = editor.state.get();
    const all = Array.from({ length: PAGE_COUNT - 1 }, (_, i) => i + 1);
    const isUsed = (page: number): boolean => !editor.format.isEmpty(document.pages[page] ?? editor.format.empty);
    return [
        [0, TEXTS.links.noTarget],
        ...[...all.filter(isUsed), ...all.filter(page => !isUsed(page))].map((page): [number, string] => [
            page,
            `${page} ${editor.page(page).name || TEXTS.motion.isEmpty}`,
        ]),
        ...(now < PAGE_COUNT ? [] : [[now, TEXTS.links.notHere(now)] satisfies [number, string]]),
    ];
}

function codeField(editor: Editor, page: number, link: LinkField, code: 'linked1Code' | 'linked2Code'): HTMLElement {
    const value = editor.page(page)[code];
    const codes = [...CHORDS.map(held => editor.format.remoteCode(wordOf(held))), value];
    const choice = make(
        'select',
        { 'aria-label': TEXTS.links.keyOf(TEXTS.links.names[link]) },
        ...[...new Set(codes)].map(one =>
            make('option', { value: one, selected: one === value }, one === 0 ? TEXTS.links.noKey : codeText(one)),
        ),
    );
    onChoice(choice, key => editor.dispatch(editor.edits.setHeader(editor.state.get().document, page, { [code]: Number(key) })));
    return choice;
}
