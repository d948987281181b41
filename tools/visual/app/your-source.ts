// SPDX-License-Identifier: MIT
// Your robot on a serial port of this computer (Web Serial).

import type { Body } from '../model/body.ts';
import type { Connection } from '../robot/connection.ts';
import { WebSerialPort } from '../robot/web-serial-port.ts';
import { TEXTS } from '../view/texts/texts.ts';
import { FollowedRobot } from './followed-robot.ts';
import { isAdapter, withPort } from './serial-ports.ts';
import type { SourceEvents } from './simulated-source.ts';

export class YourSource {
    private readonly robot: FollowedRobot;
    private port: SerialPort | null = null;

    constructor(body: Body, events: SourceEvents, mayAsk: () => boolean) {
        this.robot = new FollowedRobot(body, events, mayAsk);
        if ('serial' in navigator) navigator.serial.addEventListener('connect', () => this.connection?.retryNow());
    }

    get connection(): Connection | null {
        return this.robot.connection;
    }

    /** Lets the person choose a port unless one was already allowed. Chosen again because nothing of ours answers there, it may be another
     *  one. false: the chooser was closed. */
    choose(): Promise<boolean> {
        const { code } = this.connection?.error ?? {};
        const isInVain = code !== undefined && code !== 'port-lost';
        return withPort(async () => {
            const known = isInVain ? undefined : (await navigator.serial.getPorts()).find(port => !isAdapter(port));
            this.port = known ?? (await navigator.serial.requestPort());
        });
    }

    connect(): void {
        if (this.port) this.robot.connect(new WebSerialPort(this.port, TEXTS.menu.port));
    }

    close(): Promise<void> {
        return this.robot.close();
    }
}
