// SPDX-License-Identifier: MIT
// Where Edit has put the terminal's cursor (firmware/edit/screen.h: rest()). That tells who has the keys:
//
//   table     a cell: nothing is open
//   line      the command row, its last one: a line, a question, a name or a play has them
//   new-line  the command row, just emptied: a line without a letter
//   list      plain text on a cleared screen: HELP, LIST, CHECK ..., until somebody has read it
//   away      plain text between a program's lines: nothing is open
//
//   table, line, new-line --line end--> away            any --cleared--> CLEARED --address--> table, line; --letter--> list
//
// Pure.

export type EditPlace = 'table' | 'line' | 'new-line' | 'list' | 'away' | 'cleared';

const ADDRESS = /^\x1b\[(\d*)(?:;\d*)?H$/;

export class EditCursor {
    private sequence = '';
    private commandRow = 0; // the lowest one that was addressed since the screen was cleared
    /** Where it is now. Whoever connects asks something first: that puts the screen away. */
    place: EditPlace = 'away';

    /** Takes what the board has said; all places where the cursor was meanwhile. */
    take(bytes: Uint8Array): ReadonlySet<EditPlace> {
        const places = new Set<EditPlace>();
        for (const byte of bytes) places.add((this.place = this.after(String.fromCharCode(byte))));
        return places;
    }

    private get isOnScreen(): boolean {
        return this.place === 'table' || this.place === 'line' || this.place === 'new-line';
    }

    private after(letter: string): EditPlace {
        if (letter !== '\x1b' && this.sequence === '') return this.afterText(letter);
        this.sequence = letter === '\x1b' ? letter : this.sequence + letter;
        if (this.sequence.length < 3 || letter < '@') return this.place;
        const sequence = this.sequence;
        this.sequence = '';
        return this.afterSequence(sequence);
    }

    private afterText(letter: string): EditPlace {
        if (this.place === 'cleared') return 'list';
        if (this.isOnScreen && (letter === '\r' || letter === '\n')) return 'away';
        return this.place === 'new-line' ? 'line' : this.place;
    }

    private afterSequence(sequence: string): EditPlace {
        if (sequence.endsWith('J') || (sequence.endsWith('n') && this.isOnScreen)) {
            // to ask for the size it goes far below
            this.commandRow = 0;
            return 'cleared';
        }
        const address = ADDRESS.exec(sequence);
        if (address && (this.isOnScreen || this.place === 'cleared')) {
            const row = Number(address[1] || 1);
            this.commandRow = Math.max(row, this.commandRow);
            return row < this.commandRow ? 'table' : 'line';
        }
        return sequence.endsWith('K') && this.place === 'line' ? 'new-line' : this.place;
    }
}
