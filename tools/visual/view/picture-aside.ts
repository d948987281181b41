// SPDX-License-Identifier: MIT
// A picture that is drawn by software, beside the page, and copied onto the page's canvas when it is done. A canvas of WebGL in the page is
// copied by the browser, which makes the whole page wait until the picture is done: 100 to 800 ms on a busy computer, for every picture.

/** Between two looks whether a picture is done. */
const LOOK_MS = 4;
const BYTES_A_PIXEL = 4;

export class PictureAside {
    /** To draw on; not in the page. */
    readonly canvas = document.createElement('canvas');
    private readonly page: HTMLCanvasElement;
    private readonly context: CanvasRenderingContext2D | null;
    private timer: ReturnType<typeof setTimeout> | null = null;
    /** Where WebGL puts a picture while nobody waits. Always the same one: of a new one the browser would ask, and wait for the answer. */
    private buffer: WebGLBuffer | null = null;
    private pixels = new Uint8Array();

    constructor(page: HTMLCanvasElement) {
        this.page = page;
        this.context = page.getContext('2d', { alpha: false });
        this.canvas.addEventListener('webglcontextlost', () => (this.buffer = null));
    }

    /** What was drawn last is not on the page yet. */
    get isBusy(): boolean {
        return this.timer !== null;
    }

    /** Puts on the page what has just been drawn, when it is done. Not while it is busy. */
    show(gl: WebGL2RenderingContext): void {
        const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
        this.makeBuffer(gl, BYTES_A_PIXEL * width * height);
        gl.bindBuffer(gl.PIXEL_PACK_BUFFER, this.buffer);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, 0);
        gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
        const done = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl.flush();
        const look = (): void => {
            const isDone = !done || gl.clientWaitSync(done, 0, 0) !== gl.TIMEOUT_EXPIRED;
            this.timer = isDone ? null : setTimeout(look, LOOK_MS);
            if (!isDone) return;
            gl.deleteSync(done);
            gl.bindBuffer(gl.PIXEL_PACK_BUFFER, this.buffer);
            gl.getBufferSubData(gl.PIXEL_PACK_BUFFER, 0, this.pixels);
            gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
            if (!gl.isContextLost()) this.put(width, height);
        };
        this.timer = setTimeout(look, LOOK_MS);
    }

    dispose(): void {
        if (this.timer !== null) clearTimeout(this.timer);
        this.timer = null;
    }

    private makeBuffer(gl: WebGL2RenderingContext, bytes: number): void {
        if (this.buffer && this.pixels.length === bytes) return;
        gl.deleteBuffer(this.buffer);
        this.buffer = gl.createBuffer();
        this.pixels = new Uint8Array(bytes);
        gl.bindBuffer(gl.PIXEL_PACK_BUFFER, this.buffer);
        gl.bufferData(gl.PIXEL_PACK_BUFFER, bytes, gl.STREAM_READ);
    }

    /** WebGL begins at the lower edge. */
    private put(width: number, height: number): void {
        const upright = new ImageData(width, height);
        const row = BYTES_A_PIXEL * width;
        for (let y = 0; y < height; y++) upright.data.set(this.pixels.subarray(row * y, row * (y + 1)), row * (height - 1 - y));
        if (this.page.width !== width || this.page.height !== height) Object.assign(this.page, { width, height });
        this.context?.putImageData(upright, 0, 0);
    }
}
