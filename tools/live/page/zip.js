// zip.js: files in one .zip, stored as they are (PKWARE's APPNOTE: local headers, central directory, end). Below 4 GiB.

const table = Uint32Array.from({ length: 256 }, (_, k) => {
    for (let bit = 0; bit < 8; ++bit) k = k & 1 ? 0xedb88320 ^ (k >>> 1) : k >>> 1;
    return k;
});

function checksum(bytes) {
    let sum = ~0;
    for (const byte of bytes) sum = table[(sum ^ byte) & 255] ^ (sum >>> 8);
    return ~sum >>> 0;
}

const words = (...pairs) => { // [bytes, value] each, little-endian
    const out = [];
    for (const [size, value] of pairs) for (let k = 0; k < size; ++k) out.push((value / 256 ** k) & 255);
    return Uint8Array.from(out);
};

// files: [name, Uint8Array or text] each. The time of all is 1980, so that the same files are the same archive.
export function zipOf(files) {
    const encoder = new TextEncoder(), parts = [], directory = [];
    let at = 0;
    for (const [name, content] of files) {
        const bytes = typeof content === 'string' ? encoder.encode(content) : content, label = encoder.encode(name);
        const common = [[2, 20], [2, 0x0800], [2, 0], [2, 0], [2, 33], [4, checksum(bytes)], [4, bytes.length], [4, bytes.length], [2, label.length], [2, 0]];
        directory.push(words([4, 0x02014b50], [2, 20], ...common, [2, 0], [2, 0], [2, 0], [4, 0], [4, at]), label);
        const head = words([4, 0x04034b50], ...common);
        parts.push(head, label, bytes);
        at += head.length + label.length + bytes.length;
    }
    const size = directory.reduce((sum, part) => sum + part.length, 0);
    const end = words([4, 0x06054b50], [2, 0], [2, 0], [2, files.length], [2, files.length], [4, size], [4, at], [2, 0]);
    return new Blob([...parts, ...directory, end], { type: 'application/zip' });
}
