// SPDX-License-Identifier: MIT
// A picture without visible changes is not drawn again; one with any visible change is.
import { BoxGeometry, Color, Group, Mesh, MeshStandardMaterial, PerspectiveCamera } from 'three';
import { expect, test } from 'vitest';
import { PictureChange } from '../view/picture-change.ts';

function room() {
    const arm = new Group();
    const hand = new Mesh(new BoxGeometry(), new MeshStandardMaterial());
    const ghost = new Mesh(new BoxGeometry(), new MeshStandardMaterial());
    hand.position.set(0, 0, 0.1);
    arm.add(hand);
    const all = new Group();
    all.add(arm, ghost);
    const camera = new PerspectiveCamera();
    const change = new PictureChange();
    const take = (): boolean => change.take(all, camera);
    expect(take()).toBe(true);
    expect(take()).toBe(false);
    return { arm, hand, ghost, camera, change, take };
}

test('what trembles as a servo does that holds is not drawn, what moves is, also when it creeps', () => {
    const { arm, take } = room();
    arm.rotation.x = 0.0006;
    expect(take()).toBe(false);
    arm.rotation.x = -0.0002;
    expect(take()).toBe(false);
    arm.rotation.x = 0.002;
    expect(take()).toBe(true);
    let drawn = 0;
    for (let frame = 0; frame < 100; frame++) {
        arm.rotation.x += 0.0003;
        if (take()) drawn++;
    }
    expect(drawn).toBeGreaterThan(20);
    arm.position.x = 0.001;
    expect(take()).toBe(true);
});

test.each<[string, (parts: ReturnType<typeof room>) => void]>([
    ['the camera by a hair', ({ camera }) => camera.rotateZ(0.0002)],
    ['a colour', ({ hand }) => hand.material.color.set(0xff0000)],
    ['what lights up under the mouse', ({ hand }) => (hand.material.emissiveIntensity = 0.35)],
    ['an alarm instead of the mark', ({ hand }) => (hand.material.emissive = new Color(0xe5484d))],
    ['a ghost that comes or goes', ({ ghost }) => (ghost.visible = false)],
    ['size or theme', ({ change }) => change.touch()],
])('%s', (_, action) => {
    const parts = room();
    action(parts);
    expect(parts.take()).toBe(true);
    expect(parts.take()).toBe(false);
});

test('one of two that change places', () => {
    const { hand, ghost, take } = room();
    hand.visible = false;
    expect(take()).toBe(true);
    ghost.visible = true;
    expect(take()).toBe(false);
    hand.visible = true;
    expect(take()).toBe(true);
});
