"""A page of another site, for tests of embedding. The page is on localhost and kerrd on 127.0.0.1, which are different
sites to a browser."""

import http.server
import threading


class Site:
    """A server whose page contains what `body` says."""

    def __init__(self):
        site = self

        class Page(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                self.send_response(200)
                self.send_header("Content-Type", "text/html; charset=utf-8")
                self.end_headers()
                self.wfile.write(b"<!doctype html><html lang=en><title>blog</title>" + site.body.encode())

            def log_message(self, *_):
                pass

        self.body = ""
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Page)
        self.origin = f"http://localhost:{self.server.server_port}"
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def close(self):
        self.server.shutdown()
        self.server.server_close()
