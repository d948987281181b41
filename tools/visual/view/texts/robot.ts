// SPDX-License-Identifier: MIT
// Every sentence of the page that is more than a label, in one place: what happened, and what to do.

import type { Shape } from '../../model/motion.ts';
import type { ConnectionState } from '../../robot/connection-table.ts';
import type { Where } from '../../robot/protocol.ts';
import type { RobotError, RobotErrorCode } from '../../robot/robot-error.ts';
import type { SessionState, Tab } from '../session/session.ts';

const ERRORS: Record<RobotErrorCode, string> = {
    'no-answer': 'The robot did not answer. Is it switched on? If its screen shows a "-", type GO in the terminal.',
    refused: 'The robot refused:',
    'not-connected': 'No robot is connected. Choose one at the top.',
    'port-lost': 'The cable was pulled. Plug it in again; the page reconnects by itself.',
    'port-busy': 'The port cannot be opened. Close the other program that uses it, then try again.',
    'old-browser': 'This browser is too old for My servos. It needs Chromium, Chrome or Edge 137 or later.',
    'no-serial': 'This browser cannot reach a serial port. It needs Web Serial, which Chromium has. The robot in the page works here, too.',
    foreign: 'Something answers there, but it is not Motion512. Flash our firmware: m512 flash edit-cm5.hex',
    'other-board':
        'Motion512 runs on CM-2, CM-2+ and CM-5 only, and this board is another one. Nothing is sent there; choose another port. Its boot loader calls it',
    'in-loader': 'The boot loader is waiting. Type GO in the terminal to start the firmware.',
    'no-image': 'The firmware could not be loaded, so the robot goes on as it was. Is this computer online? Then try again.',
    'was-hidden': 'This page was hidden, so what played was ended softly: a hidden page cannot keep time. Keep it in sight.',
    cancelled: 'Stopped.',
    'page-changed': 'This page has changed in the robot since it was read; nothing was written over it. Compare once more: page',
    'page-unsaved': "The page in Edit's memory has edits that are not saved. Type SAVE or UNDO in the terminal, then try again.",
    'page-not-saved':
        'The robot took this page but does not have it now. Its flash may be worn out; your page is safe here. Try again: page',
    'no-backup':
        "The robot's motions could not be saved in this browser (private window, or the disk is full), so nothing was written. Make room, then try again.",
    'needs-edit': 'The robot runs Play, and only Edit saves pages. Flash it with: m512 flash edit-cm5.hex, then try again. Motions stay.',
    'transfer-busy': 'Not done: pages of the robot are still being read or written. Try again when that has ended.',
    'pages-differ': 'Not played: your robot has another version of this motion. Write it first with "To the robot …", then play it.',
    'damaged-here':
        'Not played: this page is damaged in the document, and is not written. Take it from a backup or from the robot, or clear it: page',
    'layer-differs':
        'Not done: the robot has another version of this motion. Play it by itself, which writes it (your robot: write it with "To the robot …"); then lay it over.',
};

/** One sentence for an error; the board's own words are quoted behind it. */
export function errorText(error: RobotError): string {
    const sentence = ERRORS[error.code];
    return error.words === '' || error.code === 'no-answer' ? sentence : `${sentence} ${error.words}`;
}

const CONNECTIONS: Record<ConnectionState, string> = {
    closed: 'No robot is connected.',
    opening: 'Opening the port ...',
    asking: 'Asking the robot who it is ...',
    ready: 'Connected.',
    silent: 'The port is open, but no Motion512 answers. Switch the robot on; if its screen shows a "-", type GO in the terminal. An older Play or Edit is flashed anew: m512 flash edit-cm5.hex.',
    foreign: 'This robot runs another firmware. Flash ours with: m512 flash edit-cm5.hex. The terminal works meanwhile.',
    'other-board': 'This is no board for Motion512, says its boot loader. Nothing is sent there; the terminal works.',
    waiting: 'The cable is out. Plug it in again; the page reconnects by itself.',
};

export function connectionText(state: ConnectionState): string {
    return CONNECTIONS[state];
}

function pageTitle(state: SessionState, page: number): string {
    const name = page === state.shownPage && state.shownName ? state.shownName : state.pages.find(entry => entry.page === page)?.name;
    return name ? `page ${page} (${name})` : `page ${page}`;
}

/** What the robot does, in one sentence. */
export function doingText(state: SessionState, where: Where | null): string {
    if (state.stopped !== null) return state.stopped;
    const shown = state.shownPage === null ? '' : TEXTS.shownOnly(pageTitle(state, state.shownPage));
    return [shown, robotText(state, where)].filter(Boolean).join(' ');
}

function robotText(state: SessionState, where: Where | null): string {
    if (state.source === 'simulated' && !state.isPowered) return TEXTS.isOff;
    if (state.adapter) return state.adapter === 'out' ? TEXTS.adapterOut : TEXTS.adapterBack;
    if (state.connection !== 'ready') {
        if (state.source === 'yours') return CONNECTIONS[state.connection];
        if (state.source === 'servos') return TEXTS.searches;
        return state.isLate ? TEXTS.startsNot : TEXTS.starts;
    }
    const isEdit = state.version?.image === 'edit';
    if (!where) return isEdit ? TEXTS.editRuns : 'Ready.';
    switch (where.state) {
        case 'idle':
        case 'ready':
            return isEdit ? TEXTS.editRuns : TEXTS.waits;
        case 'approach':
            return `Going slowly to the first pose of ${pageTitle(state, where.page)}.`;
        case 'paused':
            return `Paused in ${pageTitle(state, where.page)}, step ${where.step}.`;
        case 'playing':
            return `Playing ${pageTitle(state, where.page)}, step ${where.step}.`;
        default:
            return where.state satisfies never;
    }
}

/** That the robot begins to move, or has ended: without its steps. */
export function startText(state: SessionState): string {
    const { where } = state;
    if (where === null || where.state === 'idle' || where.state === 'ready') return robotText(state, where);
    return where.state === 'paused' ? `Paused in ${pageTitle(state, where.page)}.` : `Plays ${pageTitle(state, where.page)}.`;
}

/** A thing that the chip would not forgive. */
export function violationText(kind: string, text: string): string {
    return `The firmware did what no chip allows (${kind}): ${text}. Start the robot anew under "Robot".`;
}

export const TEXTS = {
    noWebGl:
        'This browser draws no 3D picture (WebGL is off). Everything else works; to see the robot, switch WebGL on in the settings, then reload.',
    noWebAssembly:
        'This browser runs no WebAssembly, of which the robot is made. Switch it on in the settings, or open this page in another browser.',
    noPhysics: 'Physics could not be loaded, so the robot cannot fall.',
    waits: 'The robot stands and waits.',
    starts: 'The robot is starting …',
    startsNot: 'The robot in this page does not answer. If its terminal shows a "-", type GO there; otherwise start it anew under "Robot".',
    searches: 'Looking for your servos …',
    adapterOut: 'The servo adapter is out, and nothing plays. Plug it in again.',
    adapterBack: 'The servo adapter is back. The servos move again once their torque is switched on: type on in the terminal.',
    noServos:
        'No servo answers. Is their power on, is the cable of the bus in, and do they talk at 1,000,000 bits a second? Then type @reset in the terminal.',
    servosFound: (count: number, missing: readonly number[]): string =>
        `${count === 1 ? 'One servo answers' : `${count} servos answer`}. Nothing moves before you say so.${missing.length > 0 ? ` No answer from ${missing.join(', ')}: not plugged in, or two servos have that number.` : ''}`,
    servosCrashed: 'The program for your servos has stopped; servos that held go on holding. Choose My servos again.',
    isOff: 'The robot is switched off. Switch it on under "Robot".',
    shownOnly: (title: string): string => `In the picture only: ${title}.`,
    /** It waits as well; this is what one has to know of it. */
    editRuns: 'Edit runs: its screen is in the terminal.',
    editNoRemote: 'Edit hears no remote control; Play does. Flash it with: m512 flash play-cm5.hex. Motions stay.',
    fallen: 'The robot lies on the floor.',
    getUp: 'The robot lies on the floor. Press Get up.',
    held: 'A hand holds the robot.',
    crashed: 'The simulated robot has crashed. Start it anew under "Robot"; what it had saved is still there.',
    kept: 'Saved in this browser.',
    notKept: "This browser does not save the robot's memory (private window, or the disk is full). What you save is gone with the page.",
    secondRobot: 'Another tab has this robot, too, so what this one saves is gone when its tab is closed. Documents stay.',
    robotKept: 'All motions of your robot are read, and saved in this browser as a backup.',
    workNotKept:
        'This browser could not save your work (private window, or the disk is full). Save it as a file before you close the page.',
    newVersion: 'A new version of this page is there. What you have made is saved.',
    factoryFresh: 'The robot in the page forgets its motions and settings, as if it were new. Your documents here stay.',
    onlyInPage: 'This is about the robot in the page. Choose it at the top.',
} as const;

export const FAULT_TITLES: Readonly<Record<string, string>> = {
    silent: 'does not answer',
    dead: 'unplugged',
    duplicate: 'its ID twice',
    checksum: 'wrong checksums',
    noise: 'noise before answers',
    late: 'answers late',
    short: 'answers cut off',
    'two-talkers': 'answers for others',
    overload: 'overloaded',
    overheating: 'too hot',
    'low-voltage': 'low voltage',
    'angle-limit': 'angle limit',
    mishears: 'mishears',
    blocked: 'blocked',
};

/** The remote's list of keys. */
export const KEY_TEXTS = {
    keys: 'What the keys start',
    atItsEnd: 'then',
    plays: (page: number, name: string) => `${name === '' ? `Page ${page}` : name} plays; at its end the keys lead on to`,
} as const;

const TITLES: Record<Tab, string> = {
    remote: 'Remote',
    steps: 'Steps',
    curves: 'Curves',
    pages: 'Pages',
    links: 'Links',
    checks: 'Checks',
    terminal: 'Terminal',
    robot: 'Robot',
};

export const AREA_TEXTS = {
    areas: 'Areas',
    titles: TITLES,
    more: 'More',
    moreHint: 'Curves, pages, links, checks, the terminal, and what can be done to the robot',
} as const;

/** Over the picture, until somebody has begun. */
export const FIRST_TEXTS = {
    region: 'What to do first',
    what: 'A humanoid with real firmware, in your browser',
    walk: 'Walk it',
    push: 'Push it',
    teach: 'Teach it to wave',
    motions: 'or look at ten of its motions',
    walks: 'It walks as soon as it stands. The arrow keys steer it; Stop or the space bar stops it.',
    pushes: 'It is pushed as soon as it stands by itself. When it lies, press Get up.',
} as const;

/** A motion that came in the address. */
export const SENT_TEXTS = {
    region: 'A motion for you',
    title: (name: string): string => `“${name}”, a motion for you`,
    again: '▶ Play it again',
    edit: 'Look at its steps',
    teach: 'Teach your own',
    close: 'Close',
} as const;

export const TIME_TEXTS = {
    times: 'Times',
    timesHint: 'How often the steps are played, one time after another',
    takes: (seconds: string): string => `The motion takes ${seconds} seconds`,
    dragTime: 'Drag: how long the step takes',
    dragPause: 'Drag: how long it pauses',
} as const;

const SHAPES: Record<keyof Shape, string> = { rate: 'Speed', amplitude: 'Size', blend: 'Turn' };

/** How what plays is shaped, beside the pad of the remote. */
export const SHAPE_TEXTS = {
    title: 'How it goes',
    names: SHAPES,
    asStored: 'As stored',
    shapes: 'It takes it with its next step.',
    needsPlay: 'Edit runs, and only Play shapes a motion. A key of the remote brings Play back.',
    wave: 'Wave while walking',
    waveHint: 'The right arm waves, the legs go on',
} as const;

export const REMOTE_TEXTS = {
    title: 'Remote control',
    keys: 'Arrow keys or W A S D start walking and turning, 1 to 4 other motions; 6 or the space bar stops, 5 pauses. A game pad works too.',
    beside: 'More beside what plays',
    motions: 'Ten motions as moving pictures',
} as const;

export const LAW_TEXTS = {
    title: 'Law of motion',
    hint: 'By which the curves, the picture and physics in Checks play a motion.',
    exact: 'Exact',
    exactHint: 'Every way-point is met, in time',
    classic: 'Classic',
    classicHint: 'As the firmware of 2005 moved',
} as const;

export const LINE_TEXTS = {
    name: 'Lines',
    none: 'Choose a limb or a joint: its line gets a colour and its points.',
    joint: (servo: number, title: string): string => `${servo} ${title}`,
    atStep: (servo: number, title: string, step: number, position: number, degrees: string): string =>
        `${servo} ${title}, step ${step}: ${position}, ${degrees}`,
} as const;
