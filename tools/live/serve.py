"""serve.py PAGE PORT [FILE...]: PAGE's files and no others, to this machine alone (127.0.0.1), and the files that are named, for the page to open.

GET and HEAD, for the names of a list made at the start: no path is ever looked up, so that nothing beside is reached, nor by a link in PAGE that leads
out of it. Requests that come under another host's name (a page elsewhere whose name was made to lead here) are refused, and files that have grown
beyond LARGEST. Prints the address.
"""

import http.server
import io
import json
import os
import pathlib
import stat
import sys
import urllib.parse

LARGEST = 512_000_000  # bytes of a file: beyond, the page refuses it
TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".wasm": "application/wasm",
    ".json": "application/json",
    ".xml": "application/xml",
}


def stop(text):
    sys.exit(f"live: {text}")


def table(page, opened):
    folder = page.resolve()
    names = {"/" + file.name: file for file in page.iterdir() if file.is_file() and file.resolve().parent == folder}
    if "/index.html" not in names:
        stop(f"{page}: has no index.html, expected the page")
    names["/"] = names["/index.html"]
    for k, file in enumerate(opened):
        if not file.is_file():
            stop(f"{file}: is no file")
        if file.stat().st_size > LARGEST:
            stop(f"{file}: has {file.stat().st_size} bytes, expected at most {LARGEST}")
        names[f"/open/{k}"] = file
    return names


def handler_of(names, listing):
    class Handler(http.server.BaseHTTPRequestHandler):
        server_version, sys_version = "bough-live", ""
        timeout = 30

        def do_GET(self):
            self.answer(True)

        def do_HEAD(self):
            self.answer(False)

        def answer(self, body):
            host = self.headers.get("Host", "").rpartition(":")[0]
            if host not in ("127.0.0.1", "localhost"):
                return self.send_error(403, "this server answers as 127.0.0.1 alone")
            path = urllib.parse.unquote(urllib.parse.urlsplit(self.path).path)
            if path == "/open.json" and listing is not None:
                return self.send(io.BytesIO(listing), len(listing), TYPES[".json"], body)
            if path not in names:
                return self.send_error(404)
            try:
                file = open(names[path], "rb", opener=lambda name, flags: os.open(name, flags | os.O_NONBLOCK))  # a pipe would be waited for
            except OSError as error:
                return self.send_error(500, error.strerror)
            with file:
                status = os.fstat(file.fileno())
                if not stat.S_ISREG(status.st_mode):
                    return self.send_error(500, "is no regular file")
                if status.st_size > LARGEST:
                    return self.send_error(500, f"has more than {LARGEST} bytes")
                self.send(file, status.st_size, TYPES.get(names[path].suffix, "application/octet-stream"), body)

        def send(self, file, size, kind, body):
            self.send_response(200)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(size))
            self.send_header("Cache-Control", "no-cache")
            self.send_header("X-Content-Type-Options", "nosniff")
            self.end_headers()
            if body and size > 0:
                try:
                    self.connection.sendfile(file, count=size)
                except OSError:  # who asked has gone, or takes nothing
                    self.close_connection = True

        def log_message(self, *_):
            pass

    return Handler


page, port, opened = pathlib.Path(sys.argv[1]), int(sys.argv[2]), [pathlib.Path(name) for name in sys.argv[3:]]
names = table(page, opened)
listing = json.dumps([{"name": file.name, "at": f"open/{k}"} for k, file in enumerate(opened)]).encode() if opened else None
try:
    server = http.server.ThreadingHTTPServer(("127.0.0.1", port), handler_of(names, listing))
except OSError as error:
    stop(f"port {port}: {error.strerror}; --port N takes another, 0 any that is free")
print(f"http://127.0.0.1:{server.server_port}/{'?open' if opened else ''}", flush=True)
try:
    server.serve_forever()
except KeyboardInterrupt:
    pass
