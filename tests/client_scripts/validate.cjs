// validate.cjs FILE.glb ...: the Khronos validator's verdict, a line a file; exit 1 if any file has an error, no skin, or
// not one animation (a FILE.rest.glb: none).
const fs = require('fs');
const path = require('path');
const {createRequire} = require('module');
const validator = createRequire(path.join(process.cwd(), 'x.js'))('gltf-validator'); // installed in the working folder

(async () => {
    let bad = false;
    for (const file of process.argv.slice(2)) {
        const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {maxIssues: 0});
        const {numErrors, numWarnings, messages} = report.issues;
        const {animationCount, materialCount, totalVertexCount, hasSkins} = report.info;
        console.log(`validator: ${path.basename(file)}: ${numErrors} errors, ${numWarnings} warnings; ` +
            `${totalVertexCount} vertices, ${materialCount} materials, ${animationCount} animations`);
        for (const m of messages.filter(m => m.severity < 2)) console.log(`  ${m.code} ${m.pointer}: ${m.message}`);
        const animations = file.endsWith('.rest.glb') ? 0 : 1;
        if (numErrors > 0 || animationCount !== animations || !hasSkins) bad = true;
    }
    process.exit(bad ? 1 : 0);
})().catch(error => {
    console.error(error);
    process.exit(1);
});
