"""The server of the studio answers only to names of this machine."""

import socket
import threading
from collections.abc import Iterator

import pytest
from kempe.studio.server import Server, is_loopback

OWN = ["127.0.0.1", "localhost", "LocalHost:8000", "127.0.0.1:1", "[::1]", "[::1]:80", "127.1.2.3"]
OTHER = [
    "example.org",
    "localhost.example.org",
    "127.0.0.1.example.org",
    "example.org:8000",
    "192.168.1.2",
    "0.0.0.0",
    "[fe80::1]",
    "localhost:80:80",
    "localhost, example.org",
    "user@localhost",
    "localhost/",
    "[::1",
    "",
    " ",
    "2130706433",
]


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    with Server("<p>page</p>") as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield server
        server.shutdown()
        thread.join()


def answer(server: Server, *headers: str, path: str = "/") -> tuple[int, str]:
    """The code and the body of the answer to a request with these headers."""
    lines = [f"GET {path} HTTP/1.1", *headers, "Connection: close", "", ""]
    with socket.create_connection(server.server_address[:2], timeout=5) as connection:
        connection.sendall("\r\n".join(lines).encode())
        told = b"".join(iter(lambda: connection.recv(65536), b"")).decode()
    head, _, body = told.partition("\r\n\r\n")
    return int(head.split()[1]), body


@pytest.mark.parametrize("host", OWN)
def test_a_name_of_this_machine_gets_the_page(host: str, server: Server) -> None:
    assert is_loopback(host)
    assert answer(server, f"Host: {host}") == (200, "<p>page</p>")


@pytest.mark.parametrize("host", OTHER)
def test_another_name_is_refused_in_plain_words(host: str, server: Server) -> None:
    assert not is_loopback(host)
    code, body = answer(server, f"Host: {host}")
    assert code == 403
    assert "Open the address that kempe studio printed." in body and "<" not in body


def test_no_name_and_two_names_are_refused(server: Server) -> None:
    assert answer(server)[0] == 403
    assert answer(server, "Host: localhost", "Host: example.org")[0] == 403


def test_there_is_one_page_only(server: Server) -> None:
    assert answer(server, "Host: localhost", path="/etc/passwd")[0] == 404
