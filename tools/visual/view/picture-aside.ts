// SPDX-License-Identifier: MIT
// Draws with software WebGL on a canvas outside the page and copies each finished picture to the page's canvas. A WebGL canvas in the page
// would be copied by the browser, which blocks the whole page until the picture is done: 100 to 800 ms per picture on a busy computer.

/** Interval of polling for a finished picture. */
const LOOK_MS = 4;
const BYTES_A_PIXEL = 4;

export class PictureAside {
    /** Canvas to draw on; not in the page. */
    readonly canvas = document.createElement('canvas');
    private readonly page: HTMLCanvasElement;
    private readonly context: CanvasRenderingContext2D | null;
    private timer: ReturnType<typeof setTimeout> | null = null;
    /** Receives a picture without blocking. It is reused: creating a new one would block on an answer from WebGL. */
    private buffer: WebGLBuffer | null = null;
    private pixels = new Uint8Array();
    private upright = new ImageData(1, 1);

    constructor(page: HTMLCanvasElement) {
        this.page = page;
        this.context = page.getContext('2d', { alpha: false });
        if (this.context) this.context.fillStyle = getComputedStyle(page).getPropertyValue('--room'); // else black at first
        this.context?.fillRect(0, 0, page.width, page.height);
        this.canvas.addEventListener('webglcontextlost', () => (this.buffer = null));
    }

    /** The last picture drawn is not on the page yet. */
    get isBusy(): boolean {
        return this.timer !== null;
    }

    /** Copies the picture just drawn to the page when it is done. Do not call while isBusy. */
    show(gl: WebGL2RenderingContext): void {
        const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
        this.makeBuffer(gl, width, height);
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
            if (!gl.isContextLost()) this.put();
        };
        this.timer = setTimeout(look, LOOK_MS);
    }

    dispose(): void {
        if (this.timer !== null) clearTimeout(this.timer);
        this.timer = null;
    }

    private makeBuffer(gl: WebGL2RenderingContext, width: number, height: number): void {
        if (this.buffer && this.upright.width === width && this.upright.height === height) return;
        gl.deleteBuffer(this.buffer);
        this.buffer = gl.createBuffer();
        this.upright = new ImageData(width, height);
        this.pixels = new Uint8Array(this.upright.data.length);
        gl.bindBuffer(gl.PIXEL_PACK_BUFFER, this.buffer);
        gl.bufferData(gl.PIXEL_PACK_BUFFER, this.pixels.length, gl.STREAM_READ);
    }

    /** Flips the rows: WebGL starts at the lower edge. */
    private put(): void {
        const { width, height, data } = this.upright;
        const row = BYTES_A_PIXEL * width;
        for (let y = 0; y < height; y++) data.set(this.pixels.subarray(row * y, row * (y + 1)), row * (height - 1 - y));
        if (this.page.width !== width || this.page.height !== height) Object.assign(this.page, { width, height });
        this.context?.putImageData(this.upright, 0, 0);
    }
}
