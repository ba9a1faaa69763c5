"""one_file.py PAGE: PAGE/bough_live.html, the whole page in one file, to be opened from disk: styles, scripts, the library, the young maple."""

import base64
import json
import pathlib
import sys

page = pathlib.Path(sys.argv[1])


def text(name):
    return (page / name).read_text(encoding="utf-8")


def in_script(value):  # JSON that ends no script element
    return json.dumps(value).replace("</", "<\\/")


inside = {
    "wasm": base64.b64encode((page / "bough.wasm").read_bytes()).decode("ascii"),
    "worker": text("worker.js"),
    "youngMaple": text("young_maple.xml"),
}
whole = text("index.html")
begun = whole[whole.index("<script>") : whole.index("</script>") + len("</script>")]  # of files beside, which there are none of
for outside, instead in [
    (begun, ""),
    ('<link rel="stylesheet" href="style.css">', f"<style>\n{text('style.css')}</style>"),
    (
        '<script src="page.js"></script>',
        f"<script>globalThis.boughInside = {in_script(inside)};</script>\n<script>{text('page.js').replace('</script', '<' + chr(92) + '/script')}</script>",
    ),
]:
    if whole.count(outside) != 1:
        sys.exit(f"one_file.py: index.html has no line {outside}")
    whole = whole.replace(outside, instead)
(page / "bough_live.html").write_text(whole, encoding="utf-8")
