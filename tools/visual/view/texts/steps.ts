// SPDX-License-Identifier: MIT
// Every sentence of Steps, Curves and the picture while a step is edited.

export const POSE_TEXTS = {
    poseMode: 'Drag a joint, a hand, a foot or the body: the chosen step changes. The robot itself stays as it is.',
    handMode: 'Your hand pulls the robot: limp limbs follow, stiff ones resist.',
    held: 'A hand holds the robot: balance shows when it lets go.',
    tips: 'Standing like this, the robot would tip over.',
} as const;

export const STEP_TEXTS = {
    purpose:
        'A page is up to seven poses, its steps; the robot goes from one to the next. Choose a step and drag the robot in the picture.',
    empty: 'No step yet. Add the robot as it stands, or drag it in the picture.',
    copied: 'The chosen steps are in the clipboard, as text.',
    noClipboard: 'The browser keeps the clipboard to itself here. Click a step and press Ctrl+C or Ctrl+V.',
    noSteps: 'There are no steps in the clipboard. Copy some from a page, or lines that begin with "step" from a .m512 file.',
    allUsed: 'All pages are used. Clear one in Pages first.',
} as const;

export const TEACH_TEXTS = {
    handStays: 'The hand goes on holding the robot, whose legs were let go: press "Let go" to see whether it stands, or Play.',
    stiff: 'All joints hold. Let a limb go, move it, hold it, add a step.',
    limpSimulated:
        'Drag the limb in the picture; it holds when you let go of it. Then add a step. By keyboard: Pose, where the arrows turn its joints.',
    limpYours: 'Move the limp limb by hand; the picture follows. Then hold it or add a step. Support the robot: limp legs do not carry it.',
} as const;

export const FOLLOW_TEXTS = {
    offer: 'The robot follows the chosen step, slowly (60° a second)',
} as const;

export const SHOW_TEXTS = {
    show: '▷ Show',
    pause: '❙❙ Pause',
    hint: 'Shows the motion in the picture; the robot does not move',
    fromStep: 'From this step',
    fromStepHint: 'Shows the motion from the chosen step on; the robot does not move',
    loop: 'Loop',
    loopHint: 'Shows it again and again',
} as const;

export const PLAY_TEXTS = {
    startsEdit: 'The robot in the page starts anew with Edit, the firmware that saves pages.',
    startsPlay: 'The robot in the page starts anew with Play, the firmware that hears the remote control.',
} as const;

export const LAYER_TEXTS = {
    purpose: 'A second page on joints of its own while another one plays, or joints moved by code. Nothing of it is stored.',
    needsPlay: 'Edit runs, and only Play has layers.',
    needsPlayYours: 'Your robot runs Edit, and only Play has layers. Flash it with: m512 flash play-cm5.hex',
    none: 'Nothing goes on beside the play.',
    chooseJoint: 'Choose a joint in Curves or in the picture of a step, and move it by code here.',
    page: (title: string) => `Over the play: ${title}.`,
    joints: (ids: readonly number[]) => `Moved by code: joint ${ids.join(', ')}.`,
} as const;

export const CURVE_TEXTS = {
    purpose:
        "What the robot's own player will send, tick by tick. Choose a joint and drag its points: up and down the position, to the sides the time.",
    notFast: 'Every joint can follow.',
    fast: (joints: readonly number[]) =>
        `Too fast for the servo at this battery (red, dashed): joint ${joints.join(', ')}. Give the step more time.`,
    follow: 'Servos in physics',
    followHint: 'Thin lines: where the servos are, on a body in physics at 9.6 V',
    stored: 'Dotted: as stored.',
    lagsNeedJoint: 'Choose a joint to see its servo.',
    lagsComing: 'Asking physics …',
    lags: (lags: readonly (readonly [joint: number, degrees: number])[]) =>
        `Thin: the servos; behind by up to ${lags.map(([joint, degrees]) => `${Math.round(degrees)}° (joint ${joint})`).join(', ')}.`,
    noLags: 'Physics cannot tell: the robot does not stand in the first pose, or physics is not there.',
} as const;
