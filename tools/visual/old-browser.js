// SPDX-License-Identifier: MIT
// Says in one sentence that this browser cannot run the page, where it would stay empty otherwise. It is written in the JavaScript of 2009,
// because it must run there. The build puts the sentence of every language in (old-browser-plugin.ts).
(function (sentences) {
    var abilities = [
        ['JavaScript modules', 'noModule' in document.createElement('script')],
        ['WebAssembly', typeof WebAssembly === 'object'],
        ['ECMAScript 2023', 'toSpliced' in Array.prototype],
        ['DecompressionStream', typeof DecompressionStream === 'function']
    ];
    var missing = [];
    for (var i = 0; i < abilities.length; i++) if (!abilities[i][1]) missing.push(abilities[i][0]);
    if (missing.length === 0) return;
    var asked = /[?&]lang=([a-z]+)/.exec(location.search);
    var language = asked ? asked[1] : String(navigator.language).split('-')[0];
    if (!Object.prototype.hasOwnProperty.call(sentences, language)) language = 'en';
    var told = document.createElement('p');
    told.className = 'start-failed';
    told.lang = language;
    told.setAttribute('role', 'alert');
    told.textContent = sentences[language].replace('__MISSING__', missing.join(', '));
    document.body.insertBefore(told, document.body.firstChild);
})('__SENTENCES__');
