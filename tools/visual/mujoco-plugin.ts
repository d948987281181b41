// SPDX-License-Identifier: MIT
// Makes MuJoCo's JavaScript run under a strict content security policy. The published code builds its call bridges with `new Function`,
// which the policy forbids (allowing `unsafe-eval` would weaken the page). Closures replace them. The code also refers to its .wasm, which
// we compress and fetch ourselves; the reference would add 10 MB to the built page. Each place must be replaced exactly once, or the build
// fails: a new version needs a review.

import type { Plugin } from 'vite';

/** `new Function(...args, invokerFnBody)(...closureArgs)`: JavaScript calls C++. In scope there: argTypes, isClassMethodFunc,
 *  needsDestructorStack, returns, cppInvokerFunc, cppTargetFunc, humanName, minArgs, expectedArgCount. */
const INVOKER = `function (...given) {
  checkArgCount(given.length, minArgs, expectedArgCount, humanName, throwBindingError);
  const destructors = needsDestructorStack ? [] : null;
  const wired = given.map(() => undefined);
  const all = isClassMethodFunc ? [argTypes[1].toWireType(destructors, this)] : [];
  for (let i = 0; i < expectedArgCount; i++) { wired[i] = argTypes[i + 2].toWireType(destructors, given[i]); }
  const result = cppInvokerFunc(cppTargetFunc, ...all, ...wired.slice(0, expectedArgCount));
  if (destructors) { runDestructors(destructors); }
  else {
    if (isClassMethodFunc && argTypes[1].destructorFunction !== null) { argTypes[1].destructorFunction(all[0]); }
    for (let i = 0; i < expectedArgCount; i++) { argTypes[i + 2].destructorFunction?.(wired[i]); }
  }
  return returns ? argTypes[0].fromWireType(result) : undefined;
}`;

/** `new Function(...params, functionBody)(...args)`: C++ calls JavaScript. In scope: types, retType, kind, argCount. */
const CALLER = `function (obj, func, destructorsRef, args) {
  let at = args;
  const values = [];
  for (let i = 0; i < argCount; i++) { values.push(types[i].readValueFromPointer(at)); at += types[i].argPackAdvance; }
  const result = kind === 1 ? new func(...values) : kind === 0 ? func.call(obj, ...values) : func.call(...values);
  return retType.isVoid ? undefined : emval_returnValue(retType, destructorsRef, result);
}`;

const REPLACED: readonly (readonly [string, string])[] = [
    ['let [args, invokerFnBody] = createJsInvoker(argTypes, isClassMethodFunc, returns, isAsync);', ''],
    ['var invokerFn = new Function(...args, invokerFnBody)(...closureArgs);', `var invokerFn = ${INVOKER};`],
    ['var invokerFunction = new Function(...params, functionBody)(...args);', `var invokerFunction = ${CALLER};`],
    ["return new URL('mujoco.wasm', import.meta.url).href;", "return 'mujoco.wasm'; // not fetched: it is handed in"],
];

export function mujocoWithoutEval(): Plugin {
    return {
        name: 'mujoco-without-eval',
        enforce: 'pre',
        transform(code, id) {
            if (!/@mujoco[\\/]mujoco[\\/]mujoco\.js/.test(id)) return null;
            const result = REPLACED.reduce((text, [from, to]) => {
                if (text.split(from).length !== 2) this.error(`MuJoCo's JavaScript has changed: "${from}" is not there once`);
                return text.replace(from, () => to);
            }, code);
            if (/\beval\(|new Function/.test(result)) this.error("MuJoCo's JavaScript still makes code from text");
            return { code: result, map: null };
        },
    };
}
