"""A server on this machine that serves the page of the studio, and nothing else."""

from __future__ import annotations

import ipaddress
import re
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

HOST = "127.0.0.1"
#: The name in the header Host, and its port.
_NAMED = re.compile(r"(\[[0-9A-Fa-f:.]+\]|[^\[\]:\s]+)(?::\d{1,5})?")
_REFUSAL = (
    f"This server answers only to the names of this machine, such as {HOST} and localhost. "
    "Open the address that kempe studio printed.\n"
)


def is_loopback(host: str) -> bool:
    """Whether a header Host names this machine.

    A page of another host whose name leads to this machine (DNS rebinding) could read answers
    otherwise.
    """
    found = _NAMED.fullmatch(host.strip())
    if found is None:
        return False
    name = found[1].strip("[]").lower()
    try:
        return ipaddress.ip_address(name).is_loopback
    except ValueError:
        return name == "localhost"


class Server(ThreadingHTTPServer):
    """Serves one page on the loopback address.

    Args:
        page: the page as HTML.
        port: the port; 0 for a free one.
    """

    daemon_threads = True

    def __init__(self, page: str, port: int = 0) -> None:
        self.body = page.encode("utf-8")
        super().__init__((HOST, port), _Handler)

    @property
    def address(self) -> str:
        """The address of the page."""
        return f"http://{HOST}:{self.server_address[1]}/"


class _Handler(BaseHTTPRequestHandler):
    server: Server

    def do_GET(self) -> None:
        """Send the page; there is nothing else."""
        hosts = self.headers.get_all("Host", [])
        if len(hosts) != 1 or not is_loopback(hosts[0]):
            self._send(403, "text/plain", _REFUSAL.encode())
            return
        if self.path not in {"/", "/index.html"}:
            self.send_error(404)
            return
        self._send(200, "text/html", self.server.body)

    def _send(self, code: int, kind: str, body: bytes) -> None:
        self.send_response(code)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        self.send_header("Content-Length", str(len(body)))
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002 - a name of the base class
        """Requests are not printed."""
