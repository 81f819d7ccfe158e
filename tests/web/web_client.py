"""A test client for the web pages of dotpose that can violate the HTTP and WebSocket protocols."""

import json
import socket
import struct

PATIENCE_S = 60


class Client:
    """A TCP connection that speaks HTTP and WebSocket, and can violate both protocols."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), PATIENCE_S)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def send(self, data):
        self.socket.sendall(data)

    def request(self, path="/", method="GET", host="localhost", **headers):
        lines = [f"{method} {path} HTTP/1.1", f"Host: {host}"]
        lines += [f"{name.replace('_', '-')}: {value}" for name, value in headers.items()]
        self.send(("\r\n".join(lines) + "\r\n\r\n").encode())
        return self.status()

    def status(self):
        """Returns the HTTP status of the response, or 0 if the connection is closed before the end
        of the response headers.
        """
        head = b""
        try:
            while b"\r\n\r\n" not in head:
                byte = self.socket.recv(1)
                if not byte:
                    return 0
                head += byte
        except ConnectionError:
            return 0
        self.head = head.decode()
        return int(head.split()[1])

    def upgrade(self, path="/live", **headers):
        return self.request(path, Connection="Upgrade", Upgrade="websocket",
                            Sec_WebSocket_Version="13",
                            Sec_WebSocket_Key="dGhlIHNhbXBsZSBub25jZQ==", **headers)

    def send_frame(self, payload, opcode=1, flags=0x80, size=None):
        size = len(payload) if size is None else size
        head = bytes([flags | opcode])
        if size < 126:
            head += bytes([0x80 | size])
        elif size < 65536:
            head += bytes([0x80 | 126]) + struct.pack(">H", size)
        else:
            head += bytes([0x80 | 127]) + struct.pack(">Q", size)
        self.send(head + bytes(4) + payload)  # a mask of 0 does not change the payload

    def command(self, **arguments):
        self.send_frame(json.dumps(arguments).encode())

    def receive(self, size):
        data = b""
        while len(data) < size:
            part = self.socket.recv(size - len(data))
            if not part:
                raise ConnectionError("closed")
            data += part
        return data

    def message(self):
        """Returns the next message. Raises ConnectionError if the server closes the connection."""
        data = b""
        while True:
            first, second = self.receive(2)
            size = second & 127
            if size == 126:
                size = struct.unpack(">H", self.receive(2))[0]
            elif size == 127:
                size = struct.unpack(">Q", self.receive(8))[0]
            payload = self.receive(size)
            if first & 15 == 8:
                raise ConnectionError(f"closed: {payload[2:].decode()}")
            if first & 15 < 8:
                data += payload
                if first & 0x80:
                    return data

    def topic(self, name):
        """Returns the next value of a topic that the client has subscribed to."""
        while True:
            topic, _, value = self.message().partition(b"\n")
            self.command(do="next", topic=topic.decode())
            if topic.decode() == name:
                return value

    def is_ended(self):
        """Waits until the server closes the WebSocket. Returns false if it remains open."""
        try:
            while True:
                self.message()
        except ConnectionError:
            return True
        except TimeoutError:
            return False

    def is_closed(self):
        """Waits until the connection is closed. Returns false if it remains open."""
        try:
            while self.socket.recv(65536):
                pass
            return True
        except ConnectionError:
            return True
        except TimeoutError:
            return False
