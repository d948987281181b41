// SPDX-License-Identifier: MIT
// English: every text that the page shows or a screen reader speaks. Other languages are files of the same type (texts.ts). A text with
// arguments is a function that returns all of it, so that each language can have its own word order.
//
// Not here: names of motions and documents, text of the firmware (quoted), and text of m512 on files and motions.

import type { LinkField } from '../../model/page.ts';
import type { RefusalCode } from '../../model/result.ts';
import type { EditName } from '../../model/transaction.ts';
import type { VerdictKind } from '../../model/trial.ts';
import type { Suffix } from '../../model/file-formats.ts';
import type { PageFault, Shape } from '../../model/motion.ts';
import type { ConnectionState } from '../../robot/connection-table.ts';
import type { PageAccount } from '../../robot/page-write.ts';
import type { RobotErrorCode } from '../../robot/robot-error.ts';
import type { PanelButton, Tab } from '../session/session.ts';

/** Where a motion fell. motion: title of the motion that was playing; null: the one that was tried. */
export interface FallPlace {
    readonly step: number;
    readonly motion: string | null;
    readonly seconds: string;
}

/** Two limbs that intersect. mm: depth; null: they only brush. */
export interface Meeting {
    readonly a: string;
    readonly b: string;
    readonly mm: number | null;
}

type KeyText = readonly [key: string, what: string];

function plural(count: number, one: string, many: string): string {
    return count === 1 ? one : many;
}

function fallPlace({ step, motion, seconds }: FallPlace): string {
    return `in step ${step}${motion === null ? '' : ` of ${motion}`} after ${seconds} s`;
}

const errors: Record<Exclude<RobotErrorCode, 'needs-edit'>, string> = {
    'no-answer': 'The robot did not answer. Is it switched on? If the terminal shows a "-", type GO there.',
    refused: 'The robot refused:',
    'not-connected': 'No robot is connected. Choose one in the menu.',
    'port-lost': 'The cable was pulled. Plug it in again; the page reconnects by itself.',
    'port-busy': 'The port cannot be opened. Close the other program that uses it, then try again.',
    'adapter-out': 'The servo adapter is unplugged. Plug it in, then choose "My servos …" again.',
    'second-tab': 'Another tab of this page drives your servos. Go on there, or close it and choose "My servos …" again.',
    'old-browser': 'This browser is too old for My servos. It needs Chromium, Chrome or Edge 137 or later.',
    'plain-http':
        'This page came over plain http. Browsers give serial ports only to pages from https or from this computer (localhost). The robot in the page works here, too.',
    'no-serial': 'This browser cannot reach a serial port. It needs Web Serial, which Chromium has. The robot in the page works here, too.',
    foreign: 'Something answers there, but it is not Motion512. Flash our firmware: m512 flash edit-cm5.hex (CM-2: edit-cm2.hex)',
    'other-board':
        'Motion512 runs on CM-2, CM-2+ and CM-5 only, and this board is another one. Nothing is sent there; choose another port. Its boot loader gives this name:',
    'in-loader': 'The boot loader is waiting. Type GO in the terminal to start the firmware.',
    'no-image': 'The firmware could not be loaded, so the robot goes on as it was. Is this computer online? Then try again.',
    'new-version':
        'There is a new version of this page, and the file that was needed is gone; the robot goes on as it was. Reload the page.',
    'servo-failed':
        'The robot no longer follows: a servo of this move is overloaded or does not answer. See to it, then switch following on again. Servo:',
    'goes-on': 'Your robot goes on with what it did, and Stop no longer reaches it. To stop it, choose "Your robot …" in the menu again.',
    'was-hidden': 'This page was hidden, so the motion was ended softly. A hidden page cannot keep time: keep it in sight.',
    cancelled: 'Stopped.',
    dropped: 'Not done: the robot was switched off, reset or restarted first. Ask it once more.',
    'text-dropped': 'The robot was told to stop or to start anew, so the rest of the pasted text was not sent.',
    'page-changed': 'This motion has changed in the robot since it was read; nothing was written over it. Compare once more. Motion:',
    'page-unsaved': "The motion in Edit's memory has edits that are not saved. Type SAVE or UNDO in the terminal, then try again.",
    'time-stands':
        "The robot's time stands still, so it cannot say whether Edit has edits that are not saved. Let its time go on, then try again.",
    'page-mixed':
        "The motion in Edit's memory has edits that are not saved, and half of a motion from a transfer that broke off may be among them. Do not save them unseen. To drop them, type PAGE 1 in the terminal and answer y; then try again. Motion:",
    'save-failed':
        'The robot could not save a motion: no boot loader on it can write, or its flash is worn out. Our boot loader can write; it goes onto the board once, with a USB programmer. Your motions are safe here.',
    'save-pending':
        'The robot could not save this motion, and saves no other until it is restarted; its flash may be worn out there. Switch it off and on, or type @reset in the terminal; then try again: the others come first. Your motions are safe here. Motion:',
    'pages-refused':
        'The robot could not save these motions; its flash may be worn out there. All others were tried, too. Your motions are safe here. Not written:',
    'page-not-saved':
        'The robot took this motion but does not have it now. Its flash may be worn out; your motion is safe here. Try again. Motion:',
    'no-backup':
        "The robot's motions could not be saved in this browser (private window, or the disk is full), so nothing was written. Make room, then try again.",
    'transfer-busy': 'Not done: motions of the robot are still being read or written. Try again when that has ended.',
    'pages-differ': 'Not played: your robot has another version of this motion. Write it first with "To the robot …", then play it.',
    'damaged-here':
        'Not played: a motion of the document is damaged, and is not written. Take it from a backup or from the robot, or clear it. Motion:',
    'layer-differs':
        'Not done: the robot has another version of this motion. Play it by itself, which writes it (your robot: write it with "To the robot …"); then lay it over.',
};

const connections: Record<ConnectionState, string> = {
    closed: 'No robot is connected.',
    opening: 'Opening the port …',
    asking: 'Asking the robot who it is …',
    ready: 'Connected.',
    silent: 'The port is open, but no Motion512 answers. Switch the robot on. If the terminal shows a "-", type GO there. If the robot has an older Play or Edit, flash it again: m512 flash edit-cm5.hex (CM-2: edit-cm2.hex)',
    foreign: 'This robot runs another firmware. Flash ours: m512 flash edit-cm5.hex (CM-2: edit-cm2.hex). The terminal works meanwhile.',
    'other-board': 'This is not a board for Motion512, says its boot loader. Nothing is sent there; the terminal works.',
    waiting: 'The cable is unplugged. Plug it in again; the page reconnects by itself.',
};

const refusals: Record<RefusalCode, (words: string) => string> = {
    'no-such-page': words => `There is no such motion; motions are 0 to 127: ${words}.`,
    'trim-page': () => 'Number 0 holds the trim of the robot, not a motion. Choose one from 1 to 127.',
    'page-damaged': words => `This motion is damaged and cannot be edited. Clear it, or take it from a backup or a file: motion ${words}.`,
    'page-in-use': words => `There is a motion already. Choose another place, or say that it may be replaced: motion ${words}.`,
    'page-changed': words => `This motion changed while the question was open. Nothing was done; ask for it once more: motion ${words}.`,
    'page-empty': words => `There is nothing in that motion: motion ${words}.`,
    'no-such-step': words => `The motion has no such step: ${words}.`,
    'steps-full': () => 'A motion holds at most seven steps. Put the others into another motion and link it as "next".',
    'no-room': () => 'There are not enough free motions. Clear some first; nothing was changed.',
    'bad-name': words => `A name has at most 13 characters: letters without accents, digits and signs: ${words}.`,
    'bad-number': words => `A number is out of its range: ${words}.`,
    'no-such-joint': words => `There is no such joint; servo IDs are 0 to 30: ${words}.`,
};

const edits: Record<EditName, string> = {
    'set-joints': 'pose',
    'insert-step': 'new step',
    'delete-steps': 'steps deleted',
    'duplicate-steps': 'steps duplicated',
    'move-steps': 'steps moved',
    'paste-steps': 'steps pasted',
    'set-time': 'time',
    'set-pause': 'pause',
    'mirror-steps': 'mirror',
    'exchange-steps': 'left and right exchanged',
    interpolate: 'step between',
    rename: 'name',
    'set-header': 'motion settings',
    'set-link': 'link',
    'copy-page': 'motion copied',
    'move-page': 'motion moved',
    'swap-pages': 'motions exchanged',
    'clear-page': 'motion cleared',
    'replace-page': 'motion replaced',
    'replace-pages': 'motions added',
    drag: 'drag',
};

const areas: Record<Tab, string> = {
    remote: 'Remote',
    steps: 'Steps',
    curves: 'Curves',
    pages: 'Motions',
    links: 'Links',
    checks: 'Checks',
    terminal: 'Terminal',
    robot: 'Robot',
};

const links: Record<LinkField, string> = {
    next: 'next',
    exit: 'exit (on stop)',
    linked1: 'linked 1',
    linked2: 'linked 2',
    blendRight: 'blend right',
    blendLeft: 'blend left',
};

const accounts: Record<PageAccount, string> = {
    waiting: 'as it was',
    sending: 'as it was',
    saving: 'being saved …',
    written: '✓ written',
    verified: '✓ verified',
    refused: '✗ the robot could not save it',
    lost: '✗ not there after saving',
};

const pageFaults: Record<PageFault, string> = {
    checksum: 'its checksum is wrong',
    steps: 'it counts more than seven steps',
    schedule: 'its schedule is unknown',
    speed: 'its speed is 0',
    position: 'a position is above 1023',
};

/** Faults of simulated servos, by the simulator's names. */
const servoFaults: Record<string, string> = {
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

/** By name in the body file. */
const joints: Record<string, string> = {
    right_shoulder_swing: 'right shoulder swing',
    left_shoulder_swing: 'left shoulder swing',
    right_shoulder_lift: 'right shoulder lift',
    left_shoulder_lift: 'left shoulder lift',
    right_elbow: 'right elbow',
    left_elbow: 'left elbow',
    right_hip_yaw: 'right hip yaw',
    left_hip_yaw: 'left hip yaw',
    right_hip_roll: 'right hip roll',
    left_hip_roll: 'left hip roll',
    right_hip_pitch: 'right hip pitch',
    left_hip_pitch: 'left hip pitch',
    right_knee: 'right knee',
    left_knee: 'left knee',
    right_ankle_pitch: 'right ankle pitch',
    left_ankle_pitch: 'left ankle pitch',
    right_ankle_roll: 'right ankle roll',
    left_ankle_roll: 'left ankle roll',
};

/** By name in the body file. */
const limbs: Record<string, string> = {
    trunk: 'trunk',
    neck: 'neck',
    head: 'head',
    right_shoulder: 'right shoulder',
    left_shoulder: 'left shoulder',
    right_upper_arm: 'right upper arm',
    left_upper_arm: 'left upper arm',
    right_forearm: 'right forearm',
    left_forearm: 'left forearm',
    right_hip_yaw: 'right hip yaw',
    left_hip_yaw: 'left hip yaw',
    right_hip: 'right hip',
    left_hip: 'left hip',
    right_thigh: 'right thigh',
    left_thigh: 'left thigh',
    right_shank: 'right shank',
    left_shank: 'left shank',
    right_ankle: 'right ankle',
    left_ankle: 'left ankle',
    right_foot: 'right foot',
    left_foot: 'left foot',
};

/** Buttons of the board, where START and MODE are printed. */
const panel: Record<PanelButton, string> = {
    up: 'panel button up',
    down: 'panel button down',
    left: 'panel button left',
    right: 'panel button right',
    start: 'panel button START',
    mode: 'panel button MODE',
};

const shapes: Record<keyof Shape, string> = { rate: 'Speed', amplitude: 'Size', blend: 'Turn' };

const fileTypes: Record<Suffix, string> = { '.m512': 'text', '.bin': 'image', '.hex': 'Intel HEX', '.mtn': 'RoboPlus' };

/** For example "40 motions stand". */
const counted: Record<VerdictKind, (count: number) => string> = {
    stands: count => plural(count, '1 motion stands', `${count} motions stand`),
    rises: count => plural(count, '1 goes to the floor and rises', `${count} go to the floor and rise`),
    falls: count => plural(count, '1 falls', `${count} fall`),
    low: count => plural(count, '1 ends low', `${count} end low`),
    'no-start': count => `${count} cannot be judged alone`,
};

/** For a motion that does not stand in its first pose: the result when it is played after another one. */
const behind: Record<VerdictKind, (other: string) => string> = {
    stands: other => `Does not stand in its first pose. Played after ${other}, it stands.`,
    rises: other => `Does not stand in its first pose. Played after ${other}, it gets to its feet.`,
    falls: other => `Does not stand in its first pose. Played after ${other}, it stays on the floor.`,
    low: other => `Does not stand in its first pose. Played after ${other}, it ends low.`,
    'no-start': other => `Does not stand in its first pose. Played after ${other}, it is not reached.`,
};

/** By area, or by name in `titles`. */
const keys: Record<Exclude<Tab, 'checks'> | 'everywhere' | 'picture' | 'pose', readonly KeyText[]> = {
    everywhere: [
        ['?', 'these keys'],
        ['Tab, Shift+Tab', 'to the next thing, back'],
        ['← → on a tab', 'another area'],
        ['Ctrl+Z, Ctrl+Y', 'undo, redo, while the document is shown'],
        ['↑ ↓ Enter in a list', 'choose, do it'],
        ['F6', 'picture or area'],
        ['Esc', 'take it back, close'],
    ],
    remote: [
        ['↑ ↓ ← →, W A S D', 'start walking and turning'],
        ['1 … 4', 'other motions'],
        ['5', 'pause'],
        ['6, space bar', 'stop'],
    ],
    picture: [
        ['Shift+← →', 'turn the view'],
        ['Page Up, Page Down', 'from above, from below'],
        ['+ −', 'nearer, farther'],
        ['P, Shift+P', 'push the robot ahead, back (not in Pose)'],
        ['Esc', 'take a drag back'],
    ],
    pose: [
        ['← →', 'choose a joint'],
        ['↑ ↓', 'turn it (Shift: by ten)'],
        ['Shift+click', 'choose one more'],
    ],
    steps: [
        ['← →', 'choose a step (Shift: several)'],
        ['Alt+← →', 'move the chosen ones'],
        ['Ctrl+A', 'choose all'],
        ['Ctrl+C, X, V', 'copy, cut, paste as text'],
        ['D', 'duplicate'],
        ['B', 'one between this and the next'],
        ['M, Shift+M', 'mirror right to left, left to right'],
        ['X', 'exchange left and right'],
        ['Insert, Delete', 'insert, delete'],
    ],
    curves: [
        ['← →', 'choose a step'],
        ['↑ ↓', 'turn the chosen joints (Shift: by ten)'],
        ['Alt+← →', 'less or more time'],
    ],
    pages: [
        ['← → ↑ ↓', 'choose a motion'],
        ['Enter', 'its steps'],
        ['F2', 'rename'],
        ['Ctrl+C, Ctrl+V', 'take it, put it here: copied or moved'],
        ['Delete', 'clear'],
    ],
    links: [
        ['← → ↑ ↓', 'the nearest motion that way'],
        ['Enter', 'its steps'],
    ],
    terminal: [['Tab, Shift+Tab', 'leave it; all other keys go to the robot']],
    robot: [
        ['Enter, held', 'a button of the panel, held'],
        ['← →', 'a slider'],
    ],
};

export const EN = {
    page: {
        title: 'Motion512: a robot in your browser',
        description: 'A humanoid robot with the firmware of Motion512, simulated to the bit. Walk it, push it, program it.',
        couldNotStart: (why: string) => `The page could not start. Reload it. (${why})`,
        noWebGl:
            'This browser draws no 3D picture (WebGL is off). Everything else works; to see the robot, switch WebGL on in the settings, then reload.',
        lacks: (missing: string) =>
            `This browser lacks ${missing}, which this page needs: switch it on in the settings, or open the page in Chrome, Edge or Chromium 110, Firefox 115, Safari 16.4 or later.`,
        newVersion: 'There is a new version of this page. Your work is saved.',
        reload: 'New version: reload',
        toAreas: 'To the areas',
        tourHint: 'Two minutes to the first motion',
        cancel: 'Cancel',
        close: 'Close',
        ok: 'OK',
        stop: 'Stop',
        show: 'Show',
    },

    /** The menu in the header of the page. */
    menu: {
        menu: 'Menu',
        whichRobot: 'Which robot',
        robotInPage: 'Robot in this page',
        yourRobot: 'Your robot …',
        myServos: 'My servos …',
        port: (maker: string) => (maker === '' ? 'serial port' : `USB serial port (${maker})`),
        licences: 'Licences',
        theme: 'Light or dark',
        language: 'Language',
        /** Note on a translation that no native speaker has read; '' for English. */
        translation: '',
    },

    keys: {
        title: 'Keys',
        hint: 'Keys (?)',
        titles: { everywhere: 'Everywhere', picture: 'Picture', pose: 'Picture, Pose' },
        groups: keys,
    },

    areas: {
        areas: 'Areas',
        titles: areas,
        more: 'More',
        moreHint: 'Curves, motions, links, checks, the terminal, and the controls of the robot',
    },

    /** The card over the picture on a first visit. */
    first: {
        region: 'What to do first',
        what: 'A humanoid with real firmware, in your browser',
        walk: 'Walk it',
        push: 'Push it',
        teach: 'Teach it to wave',
        motions: 'or look at ten of its motions',
        walks: 'It walks as soon as it stands. The arrow keys steer it; Stop or the space bar stops it.',
        pushes: 'It is pushed as soon as it stands by itself.',
        pushed: 'When it lies, press Get up.',
    },

    /** The bar of motions below the picture. */
    actions: {
        actions: 'Motions to play',
        walk: 'Walk',
        back: 'Back',
        left: 'Turn left',
        right: 'Turn right',
        wave: 'Wave',
        bow: 'Bow',
        dance: 'Dance',
        getUp: 'Get up',
        getUpHint: 'From its face or its back, as it lies',
        getUpFace: 'Get up (face)',
        getUpBack: 'Get up (back)',
        letGo: 'Let go',
        letGoHint: 'The hand that holds the robot lets go of it',
        choose: 'Play a motion',
        all: 'All motions …',
    },

    status: {
        activity: 'What the robot does',
        message: 'Last message',
        announcements: 'Announcements',
        memory: "Robot's memory",
        starting: 'Starting …',
        timeStands: 'time stands still',
        timeRuns: (times: number) => `${times}× time`,
        ready: 'Ready.',
        waits: 'The robot stands and waits.',
        starts: 'The robot is starting …',
        startsNot:
            'The robot in this page does not answer. If its terminal shows a "-", type GO there; otherwise restart it under "Robot".',
        searches: 'Looking for your servos …',
        isOff: 'The robot is switched off. Switch it on under "Robot".',
        /** Also while the robot waits, because the user must know that Edit runs. */
        editRuns: 'Edit runs: its screen is in the terminal.',
        fallen: 'The robot lies on the floor.',
        getUp: 'The robot lies on the floor. Press Get up.',
        held: 'A hand holds the robot.',
        shownOnly: (motion: string) => `In the picture only: ${motion}.`,
        /** Live follow, for example. */
        moves: 'Going slowly to a pose.',
        approaches: (motion: string) => `Going slowly to the first pose of ${motion}.`,
        playing: (motion: string, step: number) => `Playing ${motion}, step ${step}.`,
        paused: (motion: string, step: number) => `Paused in ${motion}, step ${step}.`,
        /** For screen readers: without steps, so that they are announced once. */
        plays: (motion: string) => `Plays ${motion}.`,
        pauses: (motion: string) => `Paused in ${motion}.`,
    },

    robot: {
        errors,
        connections,
        noPhysics: 'Physics could not be loaded, so the robot cannot fall.',
        noPush: 'Physics could not be loaded, so the robot cannot be pushed. Load the page again to try once more.',
        adapterOut: 'The servo adapter is unplugged, so nothing plays. Plug it in again.',
        adapterBack: 'The servo adapter is back. The servos move again once their torque is switched on: type on in the terminal.',
        stillSearches: 'Your servos are still being looked for, so nothing was done. Try again when they are found.',
        noServos:
            'No servo answers. Is their power on? Is the bus cable plugged in? Do they talk at 1,000,000 bits a second? Check this, then type @reset in the terminal.',
        servosFound: (count: number, missing: readonly string[]) =>
            `${plural(count, 'One servo answers', `${count} servos answer`)}. Nothing moves before you say so.${missing.length > 0 ? ` No answer from ${missing.join(', ')}: not plugged in, or two servos have that number.` : ''}`,
        servosCrashed:
            'The program for your servos has crashed. Servos that held their position still hold it. Choose "My servos …" again.',
        /** board: as in `@ver` and in the names of images: "cm2". */
        needsEdit: (board: string) =>
            `The robot runs Play, and only Edit saves motions. Flash Edit with m512 flash edit-${board}.hex, then try again. Your motions stay.`,
        editNoRemote: (board: string) =>
            `Edit hears no remote control; Play does. Flash Play: m512 flash play-${board}.hex. Your motions stay.`,
        noWalk: 'A stick plays the motion with the name walk, and this robot has none. Give that name to one of its motions.',
        crashed: 'The simulated robot has crashed. Restart it under "Robot"; what it had saved is still there.',
        notKept:
            "This browser does not save the robot's memory (private window, or the disk is full). What you save is lost when you close the page.",
        second: 'Another tab keeps its robot, so this one is not kept: what it saves is lost with this tab. Close the other tab; then this one keeps its robot. Documents stay.',
        tookOver: 'The other tab is closed: this tab keeps its robot from now on.',
        otherBackedUp:
            'The other tab had saved other motions in its robot. They are kept as a backup: under "To the robot …" they can be compared.',
        otherSettings: 'The settings that the other tab had saved in its robot are not kept; this robot has its own.',
        isBackedUp: 'All motions of your robot are read, and saved in this browser as a backup.',
        /** kind and words come from the simulator. */
        violation: (kind: string, words: string) =>
            `The firmware did what no chip allows. Restart the robot under "Robot". (${kind}: ${words})`,
        startsEdit: 'The robot in the page restarts with Edit, the firmware that saves motions.',
        startsPlay: 'The robot in the page restarts with Play, the firmware that hears the remote control.',
    },

    /** The area Robot: controls of the simulated robot. */
    robotPane: {
        onlyInPage: 'This is about the robot in the page. Choose it in the menu.',
        time: 'Time',
        pause: 'Pause',
        oneTick: 'One tick',
        realTime: 'real time',
        late: (seconds: string, lateMs: number) => `${seconds} s, ${lateMs} ms late`,
        power: 'Power and panel',
        powerOn: 'Power on',
        powerOff: 'Power off',
        torqueOff: 'Torque off',
        lamps: 'Lamps',
        lit: (names: readonly string[]) => `Lamps lit: ${names.join(', ') || 'none'}`,
        panel,
        battery: 'Battery',
        room: 'Hand and floor',
        stand: 'Put on its feet',
        pushAhead: 'Push ahead',
        pushBack: 'Push back',
        slopeFront: 'Slope to the front',
        slopeLeft: 'Slope to the left',
        grip: 'Grip of the floor',
        firmware: 'Firmware',
        runPlay: 'Run Play',
        runEdit: 'Run Edit',
        fresh: 'Factory fresh',
        askFresh: 'Factory fresh?',
        freshMeans: 'The robot in the page forgets its motions and settings, as if it were new. Your documents here stay.',
        forget: 'Forget everything',
        law: 'Law of motion',
        lawHint: 'The curves, the picture and physics in Checks play a motion by this law.',
        exact: 'Exact',
        exactHint: 'Every way-point is met, in time',
        classic: 'Classic',
        classicHint: 'As the firmware of 2005 moved',
    },

    servos: {
        servos: 'Servos',
        title: 'Servos: goal (dashed) and position',
        chart: (servo: number) => `Goal and position of servo ${servo} over the last six seconds`,
        joint: 'Joint',
        goal: 'Goal',
        position: 'Position',
        state: 'State',
        fault: 'Fault',
        faultOf: (servo: number) => `Fault of servo ${servo}`,
        draw: (servo: number) => `Draw servo ${servo}`,
        noFault: 'none',
        faults: servoFaults,
        /** By bit of the servo's error byte. */
        alarms: ['voltage', 'angle limit', 'hot', 'range', 'checksum', 'overload', 'instruction'],
        holds: 'holds',
        limp: 'limp',
    },

    joints,
    limbs,
    joint: (servo: number) => `joint ${servo}`,

    remote: {
        title: 'Remote control',
        keys: 'Arrow keys or W A S D start walking and turning, 1 to 4 other motions; 6 or the space bar stops, 5 pauses. A game pad works too.',
        layers: 'Layers over the motion',
        motions: 'Ten motions as moving pictures',
        up: 'U: ahead',
        left: 'L: left',
        right: 'R: right',
        down: 'D: back',
        b1: 'button 1',
        b2: 'button 2',
        b3: 'button 3',
        b4: 'button 4',
        b5: '5: pause',
        b6: '6: stop',
        keysStart: 'What the keys start',
        atItsEnd: 'then',
        leadsOn: (page: number, name: string) => `${name === '' ? `Motion ${page}` : name} plays; at its end the keys lead on to`,
        shape: 'How it goes',
        shapes,
        asStored: 'As stored',
        shaped: 'Applies from the next step on.',
        shapeNeedsPlay: 'Edit runs, and only Play shapes a motion. A key of the remote brings Play back.',
        wave: 'Wave while walking',
        waveHint: 'The right arm waves, the legs go on',
    },

    layers: {
        purpose: 'A second motion on joints of its own while another one plays, or joints moved by code. None of it is stored.',
        state: 'Layers now',
        motion: 'Motion to lay over',
        joints: 'Joints of the layer',
        ownJoints: 'on its own joints',
        chosenJoints: 'on the chosen joints',
        lay: 'Lay over',
        off: 'Layer off',
        to: 'to',
        swingBy: 'To and fro by',
        swingSeconds: 'Seconds to and fro',
        in: 'in',
        aim: 'Aim',
        aimHint: 'Goes there and holds it there',
        swing: 'Swing',
        swingHint: 'To and fro about the position',
        free: 'Free',
        freeHint: 'Back to the motion that plays',
        startPlay: 'Start Play',
        needsPlay: 'Edit runs, and only Play has layers.',
        needsPlayYours: (board: string) => `Your robot runs Edit, and only Play has layers. Flash Play: m512 flash play-${board}.hex`,
        none: 'No layers.',
        chooseJoint: 'Choose a joint in Curves or in the picture of a step, and move it by code here.',
        laid: (motion: string) => `Laid over: ${motion}.`,
        moved: (ids: readonly number[]) => `Moved by code: joint ${ids.join(', ')}.`,
    },

    picture: {
        robot: 'The robot',
        chosenJoint: 'Chosen joint',
        joint: (servo: number, title: string, position: number) => `${servo} ${title}: ${position}`,
        limpJoint: (servo: number, title: string, position: number) => `${servo} ${title}: ${position}, limp`,
        spokenJoint: (title: string, position: number) => `${title}: ${position}`,
        dragDoes: 'What a drag in the picture does',
        pose: 'Pose',
        poseHint: 'Drag a joint, a hand, a foot or the body: the chosen step changes. The robot itself stays as it is.',
        hand: 'Hand',
        handHint: 'Your hand pulls the robot: limp limbs follow, stiff ones resist.',
        view: 'View',
        soleFlat: 'Feet stay flat',
        onionSkin: 'Steps before and after',
        balance: 'Balance',
        stays: 'Stays:',
        whichStays: 'Which foot stays',
        lower: 'lower foot',
        right: 'right foot',
        left: 'left foot',
        chosenJoints: 'Chosen joints',
        limbsMeet: 'Limbs that meet',
        held: 'A hand holds the robot: balance shows when it lets go.',
        tips: 'Standing like this, the robot would tip over.',
        margin: (mm: number) => `Balance: ${mm} mm inside the soles`,
        touching: (pairs: readonly Meeting[], more: number) =>
            `Touching: ${pairs.map(({ a, b, mm }) => `${a} and ${b}${mm === null ? '' : ` (${mm} mm)`}`).join('; ')}${more > 0 ? `; ${more} more` : ''}`,
    },

    /** Names of motions and documents. */
    motion: {
        title: (page: number, name: string) => (name === '' ? `motion ${page}` : `motion ${page} (${name})`),
        trim: 'trim',
        empty: 'empty',
        isEmpty: '(empty)',
        nameless: '(no name)',
        damaged: '⚠ damaged',
        steps: (count: number) => plural(count, '1 step', `${count} steps`),
        stepsShort: (count: number) => `${count} st`,
        card: (page: number, name: string) => (name === '' ? `motion ${page}` : `motion ${page} ${name}`),
        ofRobotDiffers: 'The robot has another version of this motion.',
    },

    document: {
        document: 'Document',
        autosave: 'Autosave',
        saved: '✓ saved',
        saving: 'saving …',
        savesNot: '⚠ This browser does not save your work (private window, or the disk is full). Save it as a file.',
        couldNotSave:
            'This browser could not save your work (private window, or the disk is full). Save it as a file before you close the page.',
        mine: 'My motions',
        ofMyRobot: 'My robot',
        nameless: 'without a name',
        copyWord: 'copy',
        unreadable: (name: string) => `${name} (cannot be read; it stays as it is)`,
        create: 'New document …',
        createTitle: 'New document',
        copy: 'Copy of this one …',
        copyTitle: 'Copy of this document',
        fromRobot: 'What the robot has …',
        fromRobotTitle: 'What the robot has, as a document',
        rename: 'Rename …',
        renameTitle: 'Rename this document',
        name: 'Name',
        remove: 'Delete …',
        removeTitle: 'Delete this document?',
        removal: (name: string) => `"${name}" is removed from this browser. This cannot be undone. Robots and files keep what they have.`,
        removes: 'Delete',
        secondTab: (name: string) =>
            `Another tab has this document open, so this one has a copy: ${name}. What you change here is kept in the copy alone.`,
        gone: (name: string) => `${name} is not there any more. Another tab has deleted it.`,
        notRenamed: (name: string) => `${name} was not renamed: another document is open now. Open ${name} and rename it there.`,
        forgotten: (steps: number) =>
            `Undo: the first ${steps} changes of this document can no longer be undone. The document itself is complete.`,
        undo: 'Undo',
        redo: 'Redo',
        undoes: (edit: string, where: string) => `Undo: ${edit} (${where})`,
        redoes: (edit: string, where: string) => `Redo: ${edit} (${where})`,
        edits,
        editedMotion: (page: number) => `motion ${page}`,
        editedMotions: (count: number) => `${count} motions`,
        toRobot: 'To the robot …',
        toRobotCount: (count: number) => `To the robot (${count}) …`,
        refusals,
    },

    steps: {
        purpose:
            'A motion is up to seven poses, its steps; the robot goes from one to the next. Choose a step and drag the robot in the picture.',
        choose: 'Motion',
        nameOf: 'Name of the motion',
        name: 'name',
        create: 'New motion',
        createHint: 'The first empty one',
        play: '▶ Play',
        ofLibrary: 'This motion belongs to the library that the robot came with. Edit a copy of it?',
        editsCopy: 'Edit a copy',
        editsItself: 'Edit the original',
        allUsed: 'All motions are used. Clear one in Motions first.',
        row: 'Steps of the motion',
        empty: 'No step yet. Add the robot as it stands, or drag it in the picture.',
        step: (step: number) => `Step ${step}`,
        time: 'time',
        pause: 'pause',
        timeOf: (step: number) => `Time of step ${step}`,
        pauseOf: (step: number) => `Pause of step ${step}`,
        speedHint: 'Speed (256 = 720 degrees a second)',
        secondsHint: 'Seconds to get there',
        chosen: 'Chosen steps',
        withKey: (hint: string, key: string) => `${hint} (${key})`,
        insert: 'Insert',
        insertHint: 'A step before the chosen one, half-way to it',
        duplicate: 'Duplicate',
        duplicateHint: 'The chosen steps once more',
        between: 'Between',
        betweenHint: 'A step half-way between this one and the next',
        mirrorLeft: 'Mirror ◂',
        mirrorLeftHint: 'The left side becomes the mirror image of the right',
        mirrorRight: 'Mirror ▸',
        mirrorRightHint: 'The right side becomes the mirror image of the left',
        exchange: 'Exchange sides',
        exchangeHint: 'Left becomes right and right becomes left',
        copy: 'Copy',
        copyHint: 'As readable text, for another motion or window',
        paste: 'Paste',
        pasteHint: 'After the chosen step',
        remove: 'Delete',
        removeHint: 'The chosen steps',
        insertKey: 'Insert',
        deleteKey: 'Delete',
        shiftKey: 'Shift',
        copied: 'The chosen steps are in the clipboard, as text.',
        noClipboard: 'The browser keeps the clipboard to itself here. Click a step and press Ctrl+C or Ctrl+V.',
        noSteps:
            'There are no steps in the clipboard. Copy some from a motion, or from a .m512 file lines that begin with "step" and the line "# ID" above them.',
        unreadStep: (line: string) =>
            `This line cannot be pasted: "${line}". A pasted step has its times in units, 0 to 255 (step 64 pause 8), and positions 0 to 1023 with an ID each (1:600) or the line "# ID" above. "Open …" reads all other forms from a .m512 file.`,
        times: 'Times',
        timesHint: 'How often the steps are played, one time after another',
        takes: (seconds: string) => `The motion takes ${seconds} seconds`,
        dragTime: 'Drag: how long the step takes',
        dragPause: 'Drag: how long it pauses',
        secondsPossible: (least: string, most: string) => `Nothing was changed: from ${least} to ${most} seconds are possible here.`,
        numbersPossible: (least: number, most: number) => `Nothing was changed: whole numbers from ${least} to ${most} are possible here.`,
        follow: 'The robot follows the chosen step, slowly (60° a second)',
    },

    teach: {
        title: 'Teach by hand: let go of',
        state: 'Teaching',
        rightArm: 'Right arm',
        leftArm: 'Left arm',
        rightLeg: 'Right leg',
        leftLeg: 'Left leg',
        hold: 'Hold',
        add: 'Add step from the robot',
        handStays: 'The legs were limp, so the hand still holds the robot. Press "Let go" to see whether it stands, or press Play.',
        stiff: 'All joints hold. Let a limb go, move it, hold it, add a step.',
        limpSimulated:
            'Drag the limb in the picture; it holds when you let go of it. Then add a step. By keyboard: in Pose, the arrow keys turn its joints.',
        limpYours:
            'Move the limp limb by hand; the picture follows. Then hold it or add a step. Support the robot: limp legs do not carry it.',
    },

    /** Preview of a motion in the picture, without the robot. */
    preview: {
        inPicture: 'In the picture',
        show: '▷ Show',
        pause: '❙❙ Pause',
        hint: 'Shows the motion in the picture; the robot does not move',
        fromStep: 'From this step',
        fromStepHint: 'Shows the motion from the chosen step on; the robot does not move',
        moment: 'Moment of the motion',
        loop: 'Loop',
        loopHint: 'Shows it again and again',
    },

    curves: {
        purpose:
            "What the robot's own player will send, tick by tick. Choose a joint and drag its points: up and down the position, to the sides the time.",
        curves: 'Curves of the joints',
        lines: 'Lines',
        otherLines: 'Other lines',
        tooFast: 'Too fast',
        joints: 'Joints to edit',
        noLine: 'Choose a limb or a joint: its line gets a colour and its points.',
        line: (servo: number, title: string) => `${servo} ${title}`,
        atStep: (servo: number, title: string, step: number, position: number, degrees: string) =>
            `${servo} ${title}, step ${step}: ${position}, ${degrees}`,
        notFast: 'Every joint can follow.',
        fast: (ids: readonly number[]) =>
            `Too fast for the servo at this battery voltage (red, dashed): joint ${ids.join(', ')}. Give the step more time.`,
        follow: 'Servos in physics',
        followHint: 'Thin lines: where the servos are, on a body in physics at 9.6 V',
        stored: 'Dotted: as stored.',
        lagsNeedJoint: 'Choose a joint to see its servo.',
        lagsComing: 'Asking physics …',
        lags: (lags: readonly (readonly [joint: number, degrees: number])[]) =>
            `Thin: the servos; behind by up to ${lags.map(([joint, degrees]) => `${Math.round(degrees)}° (joint ${joint})`).join(', ')}.`,
        noLags: 'Physics cannot tell: the robot does not stand in the first pose, or physics is not loaded.',
    },

    motions: {
        purpose: 'Motions: the 128 of this document. Drag one to copy or move it; double-click to edit its steps.',
        chosen: 'The chosen motion',
        search: 'Search',
        searchLabel: 'Search motions',
        which: 'Which motions',
        all: 'All motions',
        used: 'In use',
        changed: 'Not in the robot',
        nothingFound: 'No motion has this name. Empty the search to see all of them.',
        renameTitle: (motion: string) => `Rename ${motion}`,
        nameHint: 'At most 13 characters: letters without accents, digits and signs.',
        transfer: 'Copy or move …',
        transferTitle: 'Copy or move',
        transferTo: (motion: string) => `Copy or move ${motion}`,
        toNumber: 'To number',
        numberHint: 'A number from 1 to 127.',
        transferAsk: (from: string, to: string) => `You put ${from} on ${to}. Copy or move it?`,
        transferReplaces: (from: string, to: string) =>
            `You put ${from} on ${to}, which is not empty. Copy and Move replace it; Exchange keeps both. Undo brings it back.`,
        copy: 'Copy',
        move: 'Move',
        swap: 'Exchange',
        linksFollow: 'Links of other motions follow what is moved',
        clear: 'Clear …',
        clearTitle: (motion: string) => `Clear ${motion}?`,
        clearMeans: (motion: string) => `${motion} will be empty. Links of other motions still lead there. Undo brings it back.`,
        clears: 'Clear',
        compare: 'Compare …',
    },

    links: {
        purpose: 'Links: which motion follows which. Click a motion to choose it, drag from one to another to link them, or use the list.',
        none: 'No motion has steps yet, so there is nothing to link.',
        chart: 'Links between motions',
        names: links,
        legend: {
            next: 'next',
            exit: 'exit, on stop',
            linked: 'linked, by a key',
            blend: 'blend partner',
            dead: '⚠ nothing to play there',
        },
        link: (from: string, link: string, key: string, to: string, isDead: boolean) =>
            `${from}, ${link}${key === '' ? '' : ` by ${key}`}: ${to}${isDead ? ', where nothing can be played' : ''}`,
        calls: (key: string) => `${key} calls it`,
        toItself: (names: readonly string[]) => `${names.join(', ')}: itself`,
        byNumber: 'played by its number',
        isDead: 'nothing to play here',
        exitsRound: 'exits go in a circle',
        of: (motion: string) => `Links of ${motion}`,
        leadsHere: 'Leads here',
        noneLeads: 'No motion.',
        leads: (motion: string, link: string, key: string) => `${motion} by ${link}${key === '' ? '' : ` ${key}`}`,
        show: (link: string) => `Show ${link}`,
        keyOf: (link: string) => `Key of ${link}`,
        noTarget: 'none',
        notHere: (page: number) => `${page}, not in the document`,
        noKey: 'no key',
        ask: 'Link',
        which: (from: string, to: string) => `Which link of ${from} should lead to ${to}?`,
        trimStays: 'Number 0 is the trim of the robot it was read from. It is never written into another one.',
    },

    checks: {
        purpose: 'Checks: what would not play, what is too much for the servos or the balance, and what may surprise you.',
        result: 'Result of the checks',
        findings: 'Findings',
        fault: '⚠ fault',
        note: 'to know',
        show: (motion: string) => `Show ${motion}`,
        showStep: (motion: string, step: number) => `Show ${motion}, step ${step}`,
        counted: (faults: number, notes: number) => `${plural(faults, '1 fault', `${faults} faults`)}, ${notes} to know.`,
        allGood: (count: number) => `${plural(count, '1 motion', `${count} motions`)} in use, no faults found.`,
        checking: 'm512 checks too: its program is being loaded (5 MB, once) …',
        noM512: "m512's checks could not be loaded. This list has only what the firmware itself and the body say.",
        pageFaults,
        damaged: (why: string) => `Damaged: ${why}. It is not played. Clear it, or take it from a backup or a file.`,
        tooFast: (step: number | null, joint: string, times: string, volts: number) =>
            `${step === null ? 'The' : `Step ${step}: the`} ${joint} is asked for ${times} times the speed that suits the servo at ${volts} V, and lags behind. Give the step more time.`,
        leadIn: (before: string) => `This happens after ${before}.`,
        outOfReach: (step: number | null, joint: string) =>
            `${step === null ? 'The' : `Step ${step}: the`} ${joint} is turned farther than the body allows.`,
        tipsOver: (step: number | null, mm: number) =>
            `${step === null ? 'Held' : `Step ${step}: held`} like this it tips over: its centre of mass is ${mm} mm outside the soles. In a fast motion, or lying, that may be meant.`,
        exitCircle:
            'Its exit links go round in a circle, so a stop comes to no motion that ends. The robot breaks the circle off where it began.',
    },

    /** Trials of motions in physics. */
    trials: {
        purpose: 'Physics: plays motions on a body of their own, as fast as it can; the robot in the picture stays as it is.',
        state: 'What physics says',
        tried: 'Motions tried',
        tryOne: (motion: string) => `Try ${motion}`,
        tryAll: 'Try all motions',
        stop: 'Stop trying',
        loading: 'Physics is being loaded …',
        failed: (why: string) => `Physics could not be loaded, so falls cannot be found. Try again. (${why})`,
        trying: (motion: string, number: number, total: number) => `Trying ${motion}: ${number} of ${total} …`,
        stale: (finding: string) => `Before the last change: ${finding}`,
        notTried: 'No motion has been tried yet.',
        counted,
        untried: (count: number) => `${count} not tried yet`,
        changed: (count: number) => `${count} changed since ${plural(count, 'it was', 'they were')} tried`,
        list: (parts: readonly string[]) => `${parts.join(', ')}.`,
        stands: (seconds: string) => `Stands for ${seconds} s. It goes on, but was tried no longer.`,
        rises: (at: FallPlace) => `Goes to the floor ${fallPlace(at)}, and is on its feet in the end.`,
        falls: (at: FallPlace) =>
            `Falls ${fallPlace(at)}, and stays on the floor. Give the step more time, or keep the weight over the foot that carries.`,
        low: 'Stays upright, but does not end on its soles alone: it sits, kneels or leans.',
        cannotJudge: 'Cannot be judged: it does not stand in its first pose. It begins lying, or in the middle of a movement.',
        behind,
        touch: (steps: readonly number[], a: string, b: string, mm: number) => {
            const where =
                steps.length === 1
                    ? `Step ${steps[0]}, or the way to it`
                    : `Steps ${steps.slice(0, -1).join(', ')} and ${steps.at(-1)}, or the ways to them`;
            return `${where}: ${a} and ${b} meet (${mm} mm). Servos push against each other.`;
        },
    },

    compare: {
        title: 'Compare and write',
        purpose:
            'What differs, motion by motion. Strong: what would come. Pale: what is there now. A backup of the robot is saved before anything is written.',
        with: 'With',
        withLabel: 'Compare with',
        file: 'A file …',
        fileLabel: 'File to compare with',
        differing: 'Motions that differ',
        transfer: 'Transfer',
        progress: 'Progress',
        tryAgain: 'Try again',
        readAgain: 'Read the robot again',
        same: 'Nothing differs.',
        damagedStays: 'This motion is damaged and is not copied.',
        wordsComing: 'In words: a moment …',
        noWords: 'The words could not be loaded; the pictures are right.',
        more: (count: number) => `${count} more`,
        takeRobots: "Take the robot's",
        takeRobotsNamed: (motion: string) => `Take the robot's ${motion}`,
        take: 'Copy here',
        takeNamed: (motion: string) => `Copy here ${motion}`,
        takeCount: (count: number) => `Copy ${plural(count, '1 motion', `${count} motions`)} into the document`,
        writeCount: (count: number) => `Write ${plural(count, '1 motion', `${count} motions`)} into the robot`,
        robotInPage: 'The robot in this page',
        myServos: 'My servos',
        yourRobot: (port: string) => `Your robot (${port})`,
        document: (name: string) => `${name} (document)`,
        backup: (robot: string, when: string) => `Backup of ${when}, ${robot}`,
        accounts,
        asks: 'Asking the robot which motions it has …',
        reads: (number: number, total: number) => `Reading motion ${number} of ${total} …`,
        prepares: 'Preparing: the robot is read and saved as a backup …',
        writes: (done: number, total: number) => `Written: ${done} of ${total} motions …`,
        written: (total: number) => `Written and verified: ${plural(total, '1 motion', `${total} motions`)}.`,
        putBack: (page: number) =>
            `Edit's memory had half of motion ${page} from a transfer that broke off. It is dropped; the saved motion is as it was.`,
        stopped: (done: number, total: number) => `${done} of ${total} motions are done; the others are as they were.`,
        stoppedUnsure: (done: number, total: number) =>
            `${done} of ${total} motions are done. "Read the robot again" shows what it has of the others.`,
    },

    files: {
        file: 'Motion file',
        open: 'Open …',
        saveLabel: 'Save as a file',
        saveAs: 'Save as …',
        types: fileTypes,
        send: 'Send as link',
        sendHint: 'A link that holds this motion and those that it leads to',
        reading: (name: string) => `Reading ${name} …`,
        writing: (name: string) => `Making ${name} …`,
        oneOnly: (count: number) => `These are ${count} files. Drop them one after the other; none of them was opened.`,
        tooManyBytes: (name: string) => `${name} is larger than 4 MB. No motion file is that large; it was not read.`,
        unreadable: (name: string) => `${name} cannot be read. Is it a folder, or was it moved meanwhile? Choose it again.`,
        notRead: (name: string) => `${name} was not read. Nothing has changed.`,
        noPython: (why: string) =>
            `The part of this page that reads files could not be loaded. Nothing was changed. Try again; when that does not help, reload the page: there may be a new version. (${why})`,
        failed: 'That did not work',
        opened: (count: number, damaged: number) =>
            count === 0
                ? 'No motions, only the trim of the robot that the file was made on.'
                : `${plural(count, '1 motion', `${count} motions`)}. If you add them, they go into free places, with the motions that they lead to. Nothing of yours is changed.${damaged > 0 ? ` ${damaged} of them cannot be added: they are damaged.` : ''}`,
        noMotions: (name: string) => `${name} holds no motions: all of them are empty. Nothing was changed.`,
        allHere: 'All motions of the file are here already, each at its own number. Nothing was changed.',
        nothingWhole:
            'No motion of the file is whole, so none was added. Open it again and take it as a new document: that keeps damaged ones as they are.',
        trim: 'When all motions are replaced, replace number 0 too: the trim of the robot that the file was made on. Tick this only if that robot is yours.',
        add: 'Add to free places',
        addHint: 'Into motions that are empty here; what you have already stays as it is',
        asDocument: 'As a new document',
        asDocumentHint: 'Beside the documents that you have',
        replace: 'Replace all motions',
        replaceHint: 'Every motion that is here now is replaced; Undo brings them back',
        /** pages: numbers as listed by m512. */
        tooLarge: (pages: string) => `It was made for a robot with 256 motions. These have no room here: ${pages}`,
        openWithoutRest: 'Open without them',
        losses: (name: string) => `${name} cannot hold everything:`,
        understood: 'Understood',
        linkTitle: 'A link with the motion in it',
        link: 'Link',
        linkCopied: 'The link is in the clipboard. The motion itself is in it; nothing was sent anywhere.',
        linkShown: 'Copy this link. The motion itself is in it; nothing was sent anywhere.',
        nothingToSend: 'This motion is empty or damaged: there is nothing to send. Choose another one.',
        linkTooLong: 'This motion leads to more motions than fit into an address. Save a file and send that.',
        badLink: 'The link holds no whole motion; it was cut on its way. Ask for it again.',
        nameless: 'a motion without a name',
    },

    /** A motion from the page's address. */
    sent: {
        region: 'A motion for you',
        title: (name: string) => `“${name}”, a motion for you`,
        again: '▶ Play it again',
        edit: 'Look at its steps',
        teach: 'Teach your own',
    },

    tour: {
        tour: 'Tour',
        title: (at: number, of: number) => `Your first wave: ${at} of ${of}`,
        back: 'Back',
        start: 'Start',
        next: 'Next',
        done: 'Done',
        end: 'End the tour',
        send: 'Send it to a friend',
        begin: 'You will teach the robot to wave. It takes two minutes. Nothing can break, and everything can be undone.',
        openSteps: 'Motions are made in Steps. Open it.',
        newMotion: 'Press "New motion" for an empty one.',
        letGo: 'Press "Right arm": the robot lets it go, and it can be moved by hand.',
        dragUp: 'Take the right hand in the picture and drag it up, beside the head. It holds when you let go of it.',
        addFirst: 'Press "Add step from the robot": this pose is the first step.',
        dragSide: 'Drag the hand to the side.',
        addSecond: 'Add this pose as the second step.',
        dragBack: 'Drag the hand back up: a wave goes to and fro.',
        addThird: 'Add this pose as the third step.',
        name: 'Give it a name, hello for example, and press Enter.',
        times: 'One wave is not enough: put 3 into the field with the ×, and press Enter.',
        play: 'Press "Play". The robot starts Edit, its firmware that saves motions, takes the motion and waves three times. That takes a few seconds.',
        sendIt: 'That is your first motion, and it is saved in this browser. Send it to a friend: the link opens this page, and the robot waves. Press ? for all keys.',
    },

    terminal: {
        terminal: 'Terminal of the robot',
        fullScreen: 'Full screen',
        tooLong: 'That text is longer than 64 KB. It was not sent to the robot. Paste it in parts.',
    },

    /** The start page, motions.html. */
    start: {
        title: 'Motion512: ten motions',
        toRobot: 'To the robot',
        choose: 'Ten of its motions. Choose one, and the robot does it.',
        /** By name of the motion in the library: title of the card, and text below it. */
        cards: {
            walk: ['Walk', 'It goes on until you stop it.'],
            wave: ['Wave', 'The right hand, beside the head.'],
            dance: ['Dance', '120 beats a minute.'],
            kick_r: ['Kick', 'On one leg, with the other.'],
            get_up: ['Get up', 'From lying on its face.'],
            pushups: ['Push-ups', 'Four of them, and up again.'],
            bow: ['Bow', 'Forty degrees.'],
            clap: ['Clap', 'Three times.'],
            cheer: ['Cheer', 'Both arms up.'],
            sit: ['Sit down', 'On its heels, and stays there.'],
        } as Record<string, readonly [title: string, text: string]>,
    },
};
