// zip.js: files in one .zip, stored as they are (PKWARE's APPNOTE: local headers, central directory, end), and back. Below 4 GiB.

const signs = { local: 0x04034b50, entry: 0x02014b50, end: 0x06054b50 };

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
        directory.push(words([4, signs.entry], [2, 20], ...common, [2, 0], [2, 0], [2, 0], [4, 0], [4, at]), label);
        const head = words([4, signs.local], ...common);
        parts.push(head, label, bytes);
        at += head.length + label.length + bytes.length;
    }
    const size = directory.reduce((sum, part) => sum + part.length, 0);
    const end = words([4, signs.end], [2, 0], [2, 0], [2, files.length], [2, files.length], [4, size], [4, at], [2, 0]);
    return new Blob([...parts, ...directory, end], { type: 'application/zip' });
}

export const isZip = (bytes) => bytes.byteLength >= 22 && [signs.local, signs.end].includes(new DataView(bytes).getUint32(0, true));

// The files of an archive (an ArrayBuffer): [name, ArrayBuffer] each, without folders. Throws for one that is cut off, changed or compressed.
export function filesOfZip(bytes) {
    const view = new DataView(bytes), decoder = new TextDecoder(), size = view.byteLength;
    const cut = () => { throw new Error('is no whole .zip: it was cut off, or changed'); };
    const expect = (sign, at, length) => at + length <= size && view.getUint32(at, true) === sign || cut();
    let end = size - 22; // behind it there may be a comment
    while (end >= 0 && view.getUint32(end, true) !== signs.end) --end;
    if (end < 0) cut();
    const count = view.getUint16(end + 10, true), files = [];
    let at = view.getUint32(end + 16, true);
    for (let k = 0; k < count; ++k) {
        expect(signs.entry, at, 46);
        const [flags, method] = [8, 10].map((field) => view.getUint16(at + field, true));
        const [sum, stored, length, from] = [16, 20, 24, 42].map((field) => view.getUint32(at + field, true));
        const [label, extra, comment] = [28, 30, 32].map((field) => view.getUint16(at + field, true));
        if (at + 46 + label > size) cut();
        const name = decoder.decode(new Uint8Array(bytes, at + 46, label));
        at += 46 + label + extra + comment;
        if (name.endsWith('/')) continue;
        if (method !== 0 || flags & 1)
            throw new Error(`has ${name} ${flags & 1 ? 'encrypted' : 'compressed'}; the page reads .zip files that store theirs as they are: unpack it, and drop its files`);
        expect(signs.local, from, 30);
        const begin = from + 30 + view.getUint16(from + 26, true) + view.getUint16(from + 28, true);
        if (stored !== length || begin + length > size) cut();
        if (checksum(new Uint8Array(bytes, begin, length)) !== sum) cut();
        files.push([name, bytes.slice(begin, begin + length)]);
    }
    return files;
}
