// SPDX-License-Identifier: MIT
// visit.ts ADDRESS: opens a served page, waits until its robot stands, and leaves (tools/dev/cleanroom).
import { Visitor, startBrowser } from './page-bench.ts';

const address = process.argv[2];
if (address === undefined) throw new Error('visit.ts: which ADDRESS?');
const browser = await startBrowser();
try {
    const visitor = await Visitor.come(browser, address, { hasPicture: true, hasPhysics: true });
    await visitor.untilStanding().catch(async () => {
        throw new Error(`the robot does not stand; the page says: ${await visitor.page.locator('body').innerText()}`);
    });
    console.log(await visitor.doing.innerText());
    await visitor.leave();
} finally {
    await browser.close();
}
