// Validates scenes with the Khronos glTF validator: https://github.com/KhronosGroup/glTF-Validator
//
//     node validate.js SCENE.glb...
//
// Exits with 1 if there is an error or a warning. Of informations it says how many of which kind there are.
"use strict";

const fs = require("fs");
const path = require("path");
const validator = require("gltf-validator");

async function validate(file) {
    const beside = uri => fs.promises.readFile(path.join(path.dirname(file), decodeURIComponent(uri)));
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
        uri: path.basename(file),
        maxIssues: 1000,
        externalResourceFunction: async uri => new Uint8Array(await beside(uri)),
    });
    const { numErrors, numWarnings, messages } = report.issues;
    const bad = numErrors + numWarnings;
    const info = report.info;
    console.log(`${bad === 0 ? "ok " : "BAD"}  ${file}: ${numErrors} errors, ${numWarnings} warnings, `
        + `${info.totalTriangleCount} triangles, ${info.materialCount} materials`);
    messages.filter(m => m.severity < 2).forEach(m => console.log(`     ${m.code} ${m.pointer}: ${m.message}`));
    const kinds = {};
    messages.filter(m => m.severity >= 2).forEach(m => kinds[m.code] = (kinds[m.code] || 0) + 1);
    Object.entries(kinds).forEach(([code, count]) => console.log(`     information: ${count} x ${code}`));
    const images = info.resources.filter(r => r.pointer.startsWith("/images"));
    const unread = images.filter(r => !r.image);
    unread.forEach(r => console.log(`BAD  ${r.pointer} was not read`));
    return bad === 0 && unread.length === 0 && images.length > 0;
}

Promise.all(process.argv.slice(2).map(validate)).then(
    results => process.exit(results.length > 0 && results.every(Boolean) ? 0 : 1),
    error => {
        console.error(error);
        process.exit(1);
    });
