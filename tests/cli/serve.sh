#!/usr/bin/env bash
# serve.sh: the server of the page (tools/live/serve.py) gives its list of files to this machine and nothing else.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
command -v python3 >/dev/null || exit 77

mkdir page page/below
echo secret >secret.txt
echo secret >page/below/secret.txt
echo '<html>page</html>' >page/index.html
echo 'code' >page/app.js
ln -s ../secret.txt page/link.txt
ln -s app.js page/alias.js
echo '{}' >"my tree.json"
python3 "$top/tools/live/serve.py" page 0 "my tree.json" >address 2>err &
server=$!
cleanup() {
    kill "$server" 2>/dev/null || true
    rm -rf "$work"
}
for _ in $(seq 100); do [[ -s address ]] || sleep 0.1; done
port=$(sed -n 's|^http://127\.0\.0\.1:\([0-9]*\)/?open$|\1|p' address)
[[ -n $port ]] || fail "no address: $(cat address err)"

# Requests byte by byte: clients tidy paths up.
cat >ask.py <<'PY'
import socket, sys
port, head, host = int(sys.argv[1]), sys.argv[2], sys.argv[3]
with socket.create_connection(("127.0.0.1", port), timeout=20) as to:
    to.sendall(f"{head} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n".encode("latin-1"))
    got = b""
    while part := to.recv(65536):
        got += part
sys.stdout.buffer.write(got)
PY
ask() { python3 ask.py "$port" "$1" "${2:-127.0.0.1:$port}"; }
gives() { ask "$1" >answer && head -n 1 answer | grep -q ' 200 ' && grep -q "$2" answer || fail "$1: $(head -c 200 answer)"; }
refuses() { # request, code, host
    ask "$1" ${3+"$3"} >answer || true
    [[ ! -s answer ]] || head -n 1 answer | grep -qE " ($2) " || fail "$1: $(head -n 1 answer)"
    ! grep -q secret answer || fail "$1 gave what is not the page's"
}
gives "GET /" page
gives "GET /app.js" code
gives "GET /alias.js" code # a link within
gives "GET /open/0" '{}'
gives "GET /open.json" 'my tree.json'
gives "GET /%61pp.js?x=1" code
for path in /../secret.txt /..%2fsecret.txt /%2e%2e/secret.txt /%2e%2e%2fsecret.txt '/..\secret.txt' /below/secret.txt /below%2fsecret.txt /./../secret.txt //secret.txt \
    "$work/secret.txt" "file://$work/secret.txt" "/$work/secret.txt" /link.txt /open/1 /open/-1 /open/../app.js '/open/0/../../../secret.txt' /app.js%00.txt /below; do
    refuses "GET $path" 404
done
for method in POST PUT DELETE OPTIONS CONNECT TRACE; do refuses "$method /app.js" 501; done
refuses "GET /app.js" 403 "evil.example:$port"
refuses "GET /app.js" 403 "127.0.0.1.evil.example:$port"
refuses "GET /$(printf 'a%.0s' $(seq 70000))" 414

# To this machine alone: the socket is bound to the one address, in the system's own table.
hexadecimal=$(printf '%04X' "$port")
bound=$(awk -v port=":$hexadecimal" '$4 == "0A" && substr($2, length($2) - 4) == port { print $2 }' /proc/net/tcp /proc/net/tcp6)
[[ $bound == "0100007F:$hexadecimal" ]] || fail "bound to '$bound'"

# A file goes out in blocks: the server's memory holds none of them whole.
head -c 3000000 /dev/urandom >"my tree.json"
ask "GET /open/0" | tail -c 3000000 | cmp -s - "my tree.json" || fail "3 MB come otherwise"
: >"my tree.json"
gives "GET /open/0" 'Content-Length: 0'
truncate -s 300000000 "my tree.json"
gives "HEAD /open/0" 'Content-Length: 300000000'
python3 - "$port" <<'PY'
import socket, sys
with socket.create_connection(("127.0.0.1", int(sys.argv[1])), timeout=20) as to:
    to.sendall(f"GET /open/0 HTTP/1.1\r\nHost: 127.0.0.1:{sys.argv[1]}\r\n\r\n".encode())
    to.recv(1)
    assert len(to.recv(1000)) > 1  # and it goes away, of which nothing is said
PY
most=$(awk '$1 == "VmHWM:" { print $2 }' "/proc/$server/status")
[[ $most -lt 100000 ]] || fail "the server took $most kB for a file of 300 MB"

# A file in whose place a pipe has come is not waited for.
rm "my tree.json"
mkfifo "my tree.json"
ask "GET /open/0" >answer || true
grep -q '^HTTP/1.0 500 is no regular file' answer || fail "a pipe: '$(head -n 1 answer)'"
rm "my tree.json"

# A file that has grown beyond what a page takes.
truncate -s 600000000 "my tree.json"
refuses "GET /open/0" 500
kill "$server"
wait "$server" 2>/dev/null || true
[[ ! -s err ]] || fail "the server says: $(head -c 500 err)"
export PATH=$top/tools/live:$PATH
for number in 08 65536 99999999999999999999 -1 ''; do
    refused 1 "--port: is '$number', expected 0 to 65535" live --port "$number"
done
truncate -s 600000000 large.json
code=0
python3 "$top/tools/live/serve.py" page 0 large.json >out 2>err || code=$?
[[ $code -ne 0 && $(cat err) == *"large.json: has 600000000 bytes, expected at most"* ]] || fail "a large file is taken: $(cat err)"
