// SPDX-License-Identifier: MIT
// The imports that a WebAssembly module built with wasi-libc needs to start. These modules open no files and do not ask for the time of
// day. What they print is discarded; the simulated board reports trouble as violations.

const SUCCESS = 0;
const BAD_FILE = 8;
const NOT_SUPPORTED = 58;

/** Imports for a reactor module that only computes. `memory` is called when the module writes. */
export function wasiImports(memory: () => WebAssembly.Memory): WebAssembly.Imports {
    const swallow = (_fd: number, vectors: number, count: number, writtenAt: number): number => {
        const view = new DataView(memory().buffer);
        let written = 0;
        for (let i = 0; i < count; i++) written += view.getUint32(vectors + 8 * i + 4, true);
        view.setUint32(writtenAt, written, true);
        return SUCCESS;
    };
    return {
        wasi_snapshot_preview1: {
            fd_write: swallow,
            fd_close: () => BAD_FILE,
            fd_seek: () => BAD_FILE,
            fd_fdstat_get: () => BAD_FILE,
            fd_prestat_get: () => BAD_FILE, // no folder is open; wasi-libc of Debian 13 asks for this first
            fd_prestat_dir_name: () => BAD_FILE,
            clock_time_get: () => NOT_SUPPORTED,
            poll_oneoff: () => NOT_SUPPORTED,
            proc_exit: (code: number) => {
                throw new Error(`the simulated board ended with code ${code}`);
            },
        },
    };
}
