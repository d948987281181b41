// SPDX-License-Identifier: MIT
// Every sentence about files and links.

export const FILE_TEXTS = {
    reading: (name: string): string => `Reading ${name} …`,
    tooManyBytes: (name: string): string => `${name} is larger than 4 MB. No motion file is; it was not read.`,
    unreadable: (name: string): string => `${name} cannot be read. Is it a folder, or was it moved meanwhile? Choose it again.`,
    notRead: (name: string): string => `${name} was not read. Nothing has changed.`,
    writing: (name: string): string => `Making ${name} …`,
    nothingToSend: 'This page is empty or damaged: there is nothing to send. Choose another page.',
    linkTooLong: 'This page leads to more pages than fit into an address. Save a file and send that.',
    badLink: 'The link holds no whole motion; it was cut on its way. Ask for it again.',
    nameless: 'a motion without a name',
    noPython: (why: string): string =>
        `The part of this page that reads files could not be loaded (${why}). Nothing was changed. Try again; when that does not help, reload the page: there may be a new version.`,
    opened: (count: number, damaged: number): string =>
        count === 0
            ? 'No motions, only the trim of the robot that the file was made on.'
            : `${count === 1 ? '1 motion page' : `${count} motion pages`}. Added, they go into free pages with what they lead to, and nothing of yours is touched.${damaged > 0 ? ` ${damaged} of them cannot be added: they are damaged.` : ''}`,
    noMotions: (name: string): string => `${name} holds no motions: all its pages are empty. Nothing was changed.`,
    nothingWhole:
        'No page of the file is whole, so none was added. Open it again and take it as a new document: that keeps damaged pages as they are.',
    trim: 'When all pages are replaced, page 0 too: the trim of the robot that the file was made on. Leave it out unless that robot is yours.',
    addHint: 'Into pages that are empty here; what you have already stays as it is',
    documentHint: 'Beside the documents that you have',
    replaceHint: 'Every page that is here now is replaced; Undo brings them back',
    tooLarge: (pages: string): string => `It was made for a robot with 256 pages: ${pages} have no room here.`,
    linkCopied: 'The link is in the clipboard. The motion itself is in it; nothing was sent anywhere.',
    linkShown: 'Copy this link. The motion itself is in it; nothing was sent anywhere.',
    losses: (name: string): string => `${name} cannot hold everything:`,
} as const;
