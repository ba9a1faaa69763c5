"""open_page.py PAGE PICTURE: serves this folder to a headless Chromium, opens PAGE there, and waits until the page sends what it found (played.js). Prints
that as JSON and leaves the page's canvas as PICTURE. It waits for the page and for no clock: a busy machine makes it slow and not wrong.
Exit 1 with a message where the page sends nothing in ten minutes, or Chromium ends before."""
import functools, http.server, subprocess, sys, tempfile, threading

page, picture = sys.argv[1:]
patience = 600
done = threading.Event()
sent = {}


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm"}

    def do_POST(self):
        sent[self.path] = self.rfile.read(int(self.headers["Content-Length"]))
        self.send_response(204)
        self.end_headers()
        if self.path == "/found":
            done.set()

    def log_message(self, *_):
        pass


server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)  # any free port of this machine alone
threading.Thread(target=server.serve_forever, daemon=True).start()
with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile, open(f"{profile}/browser.log", "w+") as log:
    browser = subprocess.Popen(
        ["chromium", "--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=700,760",
         f"--user-data-dir={profile}", f"http://127.0.0.1:{server.server_port}/{page}"], stdout=log, stderr=log)
    threading.Thread(target=lambda: (browser.wait(), done.set()), daemon=True).start()
    in_time = done.wait(patience)
    ended = browser.poll()
    browser.kill()
    browser.wait()
    if "/found" not in sent:
        log.seek(0)
        why = f"Chromium ended with {ended}" if ended is not None else "the page sent nothing" if in_time else f"the page sent nothing in {patience} s"
        sys.exit(f"open_page: {page}: {why}\n" + "".join(log.readlines()[-5:]))
if "/picture" in sent:
    open(picture, "wb").write(sent["/picture"])
print(sent["/found"].decode())
