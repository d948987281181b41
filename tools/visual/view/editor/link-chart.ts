// SPDX-License-Identifier: MIT
// The pages as a graph, laid out by dagre and drawn as SVG. Display only.

import { Graph, layout } from '@dagrejs/dagre';
import type { LinkGraph, PageLink, PageNode } from '../../model/links.ts';
import { codeText } from '../texts/editor.ts';
import { TEXTS } from '../texts/texts.ts';

const SVG = 'http://www.w3.org/2000/svg';
const NODE = { width: 104, height: 40 };
const PADDING = 14;

export interface ChartMarks {
    readonly selected: number;
    readonly playing: number;
}

function draw(tag: string, attributes: Readonly<Record<string, string | number>>, ...children: (Node | string)[]): SVGElement {
    const element = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
    element.append(...children);
    return element;
}

/** Tooltip of a link: "walk_go → walk_l by ▲". */
function linkTitle(link: PageLink, nodes: ReadonlyMap<number, PageNode>): string {
    const title = (page: number): string => TEXTS.motion.title(page, nodes.get(page)?.name ?? '');
    return TEXTS.links.link(title(link.from), TEXTS.links.names[link.kind], codeText(link.code), title(link.to), link.isDead);
}

type Point = { readonly x: number; readonly y: number };

/** The layout. Nodes are given by their centres. */
interface Laid {
    readonly nodes: Map<number, Point>;
    readonly edges: Map<PageLink, { readonly points: readonly Point[]; readonly label: Point | null }>;
    width: number;
    height: number;
}

/** The chart; nodes have data-page. Connected pages are laid out as groups, one below the other. Pages without links fill rows at the end.
 *  `width`: available width in pixels. */
export function linkChart({ nodes, links }: LinkGraph, width: number): SVGElement {
    const byPage = new Map(nodes.map(node => [node.page, node]));
    const between = links.filter(link => link.from !== link.to);
    const groups = groupsOf([...byPage.keys()], between);
    const laid: Laid = { nodes: new Map(), edges: new Map(), width: 0, height: PADDING };
    for (const group of groups.filter(one => one.length > 1))
        placeGroup(
            laid,
            between.filter(link => group.includes(link.from)),
            group,
        );
    placeRows(laid, groups.filter(one => one.length === 1).flat(), width);
    const size = { width: Math.max(laid.width, 1) + 2 * PADDING, height: laid.height + PADDING };
    return draw(
        'svg',
        { viewBox: `0 0 ${size.width} ${size.height}`, ...size, role: 'group', 'aria-label': TEXTS.links.chart },
        markers(),
        ...between.map(link => edge(link, laid, byPage)),
        ...[...laid.nodes.keys()].map(page => box(page, laid, byPage.get(page) ?? null, links)),
    );
}

/** Groups of connected pages, the largest first. Link targets that cannot be played are included. */
function groupsOf(pages: readonly number[], links: readonly PageLink[]): number[][] {
    const group = new Map<number, number[]>(pages.map(page => [page, [page]]));
    for (const { from, to } of links) {
        const [a, b] = [group.get(from) ?? [from], group.get(to) ?? [to]];
        if (a === b) continue;
        const joined = [...a, ...b];
        for (const page of joined) group.set(page, joined);
    }
    return [...new Set(group.values())].sort((a, b) => b.length - a.length || (a[0] ?? 0) - (b[0] ?? 0));
}

function placeGroup(laid: Laid, links: readonly PageLink[], pages: readonly number[]): void {
    const graph = new Graph({ multigraph: true });
    graph.setGraph({ rankdir: 'TB', nodesep: 14, ranksep: 34, edgesep: 8 });
    graph.setDefaultEdgeLabel(() => ({}));
    for (const page of pages) graph.setNode(String(page), { ...NODE });
    for (const link of links)
        graph.setEdge(
            String(link.from),
            String(link.to),
            { width: link.code ? 46 : 4, height: link.code ? 16 : 4, labelpos: 'c' },
            link.kind,
        );
    layout(graph);
    const at = ({ x, y }: Point): Point => ({ x: x + PADDING, y: y + laid.height });
    const size = graph.graph() as { width?: number; height?: number }; // set by layout()
    for (const page of pages) laid.nodes.set(page, at(graph.node(String(page)) as Point));
    for (const link of links) {
        const { points = [] } = graph.edge({ v: String(link.from), w: String(link.to), name: link.kind }) as { points?: Point[] };
        const [a, b] = points.slice(Math.floor((points.length - 1) / 2)); // the line passes midway between them
        laid.edges.set(link, {
            points: points.map(at),
            label: link.code && a && b ? at({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 }) : null,
        });
    }
    laid.width = Math.max(laid.width, size.width ?? 0);
    laid.height += (size.height ?? 0) + 2 * PADDING;
}

function placeRows(laid: Laid, pages: readonly number[], width: number): void {
    const columns = Math.max(1, Math.floor((Math.max(width, laid.width) - 2 * PADDING + 10) / (NODE.width + 10)));
    for (const [i, page] of pages.entries()) {
        laid.nodes.set(page, {
            x: PADDING + (i % columns) * (NODE.width + 10) + NODE.width / 2,
            y: laid.height + Math.floor(i / columns) * (NODE.height + 10) + NODE.height / 2,
        });
    }
    laid.width = Math.max(laid.width, Math.min(columns, pages.length) * (NODE.width + 10) - 10);
    laid.height += Math.ceil(pages.length / columns) * (NODE.height + 10);
}

function markers(): SVGElement {
    return draw(
        'defs',
        {},
        ...['next', 'exit', 'linked', 'blend', 'dead'].map(kind =>
            draw(
                'marker',
                {
                    id: `arrow-${kind}`,
                    viewBox: '0 0 8 8',
                    refX: 7,
                    refY: 4,
                    markerWidth: 9,
                    markerHeight: 9,
                    markerUnits: 'userSpaceOnUse',
                    orient: 'auto-start-reverse',
                },
                draw('path', { d: 'M 0 0 L 8 4 L 0 8 z', class: `head ${kind}` }),
            ),
        ),
    );
}

function kindOf(link: PageLink): string {
    return link.isDead ? 'dead' : link.kind.startsWith('linked') ? 'linked' : link.kind.startsWith('blend') ? 'blend' : link.kind;
}

function edge(link: PageLink, laid: Laid, byPage: ReadonlyMap<number, PageNode>): SVGElement {
    const { points, label: at } = laid.edges.get(link) ?? { points: [], label: null };
    const kind = kindOf(link);
    const line = draw('path', { d: smooth(points), class: `link ${kind}`, 'marker-end': `url(#arrow-${kind})` });
    const label = at ? [draw('text', { x: at.x, y: at.y + 4, class: 'key' }, codeText(link.code))] : [];
    return draw(
        'g',
        { class: 'edge', 'data-source': link.from, 'data-target': link.to },
        line,
        ...label,
        draw('title', {}, linkTitle(link, byPage)),
    );
}

/** A smooth path through the midpoints of dagre's points, which are its control points. */
function smooth(points: readonly Point[]): string {
    const [first, ...rest] = points;
    if (!first) return '';
    const at = ({ x, y }: Point): string => `${x.toFixed(1)} ${y.toFixed(1)}`;
    const middle = rest.slice(0, -1).map((point, i) => {
        const next = rest[i + 1] ?? point;
        return `Q ${at(point)} ${at({ x: (point.x + next.x) / 2, y: (point.y + next.y) / 2 })}`;
    });
    const last = rest.at(-1) ?? first;
    return `M ${at(first)} ${middle.join(' ')} L ${at(last)}`;
}

function box(page: number, laid: Laid, node: PageNode | null, links: readonly PageLink[]): SVGElement {
    const { x, y } = laid.nodes.get(page) ?? { x: 0, y: 0 };
    const itself = links.filter(link => link.from === page && link.to === page).map(link => TEXTS.links.names[link.kind]);
    const oddities = [node ? '' : TEXTS.links.isDead, node?.exitsRound ? TEXTS.links.exitsRound : ''].filter(Boolean);
    const name = `${page} ${node?.name ?? ''}`.trimEnd();
    const words = [
        TEXTS.motion.card(page, node?.name ?? ''),
        node?.code ? TEXTS.links.calls(codeText(node.code)) : '',
        itself.length > 0 ? TEXTS.links.toItself(itself) : '',
        node?.isUnreachable ? TEXTS.links.byNumber : '',
        ...oddities,
    ];
    const title = words.filter(Boolean).join(', ');
    const signs = [node?.code ? codeText(node.code) : '', itself.length > 0 ? '⟲' : '', oddities.length > 0 ? '⚠' : '']
        .filter(Boolean)
        .join(' ');
    return draw(
        'g',
        {
            class: `node${node ? '' : ' dead'}${oddities.length > 0 ? ' odd' : ''}`,
            'data-page': page,
            tabindex: -1,
            role: 'button',
            'aria-label': title,
            transform: `translate(${x - NODE.width / 2} ${y - NODE.height / 2})`,
        },
        draw('rect', { width: NODE.width, height: NODE.height, rx: 7 }),
        draw('title', {}, title),
        draw('text', { x: 8, y: 17, class: 'name' }, name),
        ' ',
        draw('text', { x: 8, y: 32, class: 'signs' }, signs),
    );
}

/** Marks the selected and the playing page on an existing chart. */
export function markChart(chart: Element, { selected, playing }: ChartMarks): void {
    const nodes = [...chart.querySelectorAll<SVGElement>('.node')];
    const entry = nodes.find(node => Number(node.dataset.page) === selected) ?? nodes[0]; // the node that Tab reaches
    for (const node of nodes) {
        const page = Number(node.dataset.page);
        node.classList.toggle('selected', page === selected);
        node.classList.toggle('playing', page === playing);
        node.setAttribute('tabindex', node === entry ? '0' : '-1');
    }
    for (const line of chart.querySelectorAll<SVGElement>('.edge')) {
        line.classList.toggle('selected', Number(line.dataset.source) === selected || Number(line.dataset.target) === selected);
    }
}
