"""A controller at the other end of the link, as PROTOCOL.md describes it. Standard library only; the lengths and numbers are
those of the tables that the firmware is made of."""
import os
import re
import select
import socket
import struct
import time
import tty
import zlib

SOURCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "src")


def rows(path, macro):
    """The arguments of each row of a table."""
    with open(os.path.join(SOURCES, path), encoding="utf-8") as table:
        return [[word.strip() for word in line[len(macro) + 1:].split(",")]
                for line in table if line.startswith(macro + "(")]


TYPES = {row[1]: int(row[0], 16) for row in rows("protocol/messages.def", "MESSAGE")}
ERRORS = {int(row[0]): row[2].strip('"') for row in rows("base/errors.def", "ERROR")}
SYMBOLS = [row[2] for row in rows("model/params.def", "PARAM")]
SIGNALS = [row[2] for row in rows("protocol/signals.def", "SIGNAL")]
PRESETS = [row[0].strip('"') for row in rows("model/presets.def", "PRESET")]

# Payloads of requests and replies, for struct.
REQUESTS = {"HELLO": "BB", "PING": "Q", "STATUS": "", "DICTIONARY": "BB", "READ": "BB", "STAGE": "Bf", "COMMIT": "IB",
            "REVERT": "", "PRESET": "B", "RUN": "", "STOP": "", "RESET": "", "STEP": "IBBff", "INPUT": "QBBff", "STREAM": "II",
            "SNAPSHOT": "H", "RESTORE": "HH232s",
            "SCAN": "BBffHBBffHHHB", "MARGIN": "BfHHB", "VERDICT": "", "SELFTEST": "", "OCCURRENCE": "IIB4fHHB"}
REPLIES = {"HELLO": "BBHHHBBBBH16s32s24s16s", "PING": "Q", "STATUS": "BQIIIff24IBII", "DICTIONARY": "BBBHBBfff24s48s149s",
           "READ": "BBf", "STAGE": "BfI", "COMMIT": "IBI", "REVERT": "I", "PRESET": "II", "RUN": "Q", "STOP": "Q", "RESET": "Q",
           "STEP": "QI7fbBBBB", "INPUT": "B", "STREAM": "IIH", "SNAPSHOT": "HH232s", "RESTORE": "HQ", "SCAN": "I", "MARGIN": "I",
           "VERDICT": "6B16f", "SELFTEST": "BBI", "OCCURRENCE": "I"}
STATUS = ("state step generation hash set_crc step_s sigma events caps saturations lifted gap_held ticks overruns shed inputs late "
          "clamped inputs_refused offered sent dropped waiting accepted damaged too_long bad_cobs too_short bad_crc garbage "
          "refused input_state times_stale times_safe").split()
STEP = "step hash x xd y yd load friction v0 mode propensity motion period flags".split()
KEEP, PROFILE, FORCE, PRESSURE = range(4)
KEEP, PROFILE, DISC, VEHICLE = range(4)
VERDICT = ("propensity motion period band predicted flags amplitude_um velocity_mm_s velocity_mm_s_rms level_db acceleration_g "
           "frequency_hz level_dba_estimate growth_per_s growth_error_per_s stick slipminus predicted_growth_per_s "
           "predicted_touch_ratio onset_touch_ratio t_v10 sigma").split()
SAMPLE, ERROR = 0x40, 0xff
PIECE, STARTS = 232, 0x80

# What a study tells by itself: name and fields by the type of the frame.
RESULTS = {
    0x41: ("POINT", "Iff7B8f", "point first second error propensity motion period predicted end flags amplitude_um velocity_mm_s "
           "frequency_hz level_db growth_per_s growth_error_per_s predicted_growth_per_s periods"),
    0x42: ("BORDER", "BBB9f", "parameter now quiets value below below_quiet below_squeal below_searched "
           "above above_quiet above_squeal above_searched"),
    0x43: ("STUDY_END", "BBI12IQ3fI", "request reason results trials unknown quiet watch squeal loud undecided refused diverged caps "
           "saturations gap_held steps share low high clamped"),
}
NO_PARAMETER = 255


class Silence(Exception):
    """No answer in time."""


def stuff(data):
    out, block = b"", b""
    for byte in data:
        if byte:
            block += bytes([byte])
        if not byte or len(block) == 254:
            out += bytes([len(block) + 1]) + block
            block = b""
    return out + bytes([len(block) + 1]) + block


def unstuff(data):
    out = b""
    while data:
        code, data = data[0], data[1:]
        out, data = out + data[:code - 1], data[code - 1:]
        if data and code < 255:
            out += b"\0"
    return out


def wire(kind, sequence, step, payload=b""):
    """A frame as it goes over the line."""
    body = struct.pack("<BHI", kind, sequence, step & 0xffffffff) + payload
    return stuff(body + struct.pack("<I", zlib.crc32(body))) + b"\0"


def unwire(data):
    """(type, sequence, step, payload) of what lies between two delimiters, or None."""
    body = unstuff(data)
    if len(body) < 11 or zlib.crc32(body[:-4]) != struct.unpack("<I", body[-4:])[0]:
        return None
    return struct.unpack("<BHI", body[:7]) + (body[7:-4],)


def result(found):
    """The fields of a frame that a study has sent."""
    kind, sequence, step, payload = found
    name, form, names = RESULTS[kind]
    return dict(zip(names.split(), struct.unpack("<" + form, payload)), frame=name, sequence=sequence, step=step)


class Refused(Exception):
    """ERROR, with its fields."""

    def __init__(self, payload):
        self.type, number, self.index, self.expected, self.low, self.high = struct.unpack("<BBBIff", payload)
        self.reason = ERRORS[number]
        super().__init__(f"{self.reason} index={self.index} expected={self.expected:#x} {self.low} .. {self.high}")


class Terminal:
    """A serial line's device, used like a socket."""

    def __init__(self, path):
        self.descriptor = os.open(path, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self.descriptor)

    def fileno(self):
        return self.descriptor

    def recv(self, size):
        return os.read(self.descriptor, size)

    def sendall(self, data):
        while data:
            data = data[os.write(self.descriptor, data):]

    def close(self):
        os.close(self.descriptor)


def connect(where, limit_s):
    """A connected socket, or what is like it; patient, because the other end may not listen yet."""
    until = time.monotonic() + limit_s
    while True:
        try:
            if where.startswith("/dev/"):
                return Terminal(where)
            if where.startswith("tcp:"):
                line = socket.create_connection(("127.0.0.1", int(where[4:])), limit_s)
                line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                return line
            line = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
            line.settimeout(limit_s)
            line.connect(where)
            return line
        except OSError:
            if time.monotonic() > until:
                raise
            time.sleep(0.02)


class Controller:
    """One connection. Every wait has an end."""

    def __init__(self, where, limit_s=30.0):
        """where: the path of a socket, tcp:PORT of this machine, or a terminal in /dev/."""
        self.limit_s = limit_s
        self.socket = connect(where, limit_s)
        self.sequence, self.step_sequence, self.at, self.partial = 0, 0, 0, b""
        self.pieces, self.samples, self.results, self.raw = [], [], [], b""

    def close(self):
        self.socket.close()

    def send(self, data):
        self.socket.sendall(data)

    def any_frame(self):
        """The next frame as (type, sequence, step, payload); its bytes on the line are in raw."""
        until = time.monotonic() + self.limit_s
        while not self.pieces:
            if not select.select([self.socket], [], [], max(0.0, until - time.monotonic()))[0]:
                raise Silence("no answer")
            chunk = self.socket.recv(65536)
            if not chunk:
                raise Silence("the link has closed")
            *pieces, self.partial = (self.partial + chunk).split(b"\0")
            self.pieces += pieces
        self.raw = self.pieces.pop(0) + b"\0"
        found = unwire(self.raw[:-1])
        if found is None:
            raise Silence(f"no frame: {self.raw.hex()}")
        return found

    def frame(self):
        """The next frame that is a reply; samples and results of a study are put aside."""
        while True:
            found = self.any_frame()
            if found[0] == SAMPLE:
                self.samples.append(found[1:])
            elif found[0] in RESULTS:
                self.results.append(result(found))
            else:
                return found

    def study_end(self):
        """All results of the study under way, its STUDY_END the last of them."""
        while not self.results or self.results[-1]["frame"] != "STUDY_END":
            found = self.any_frame()
            (self.results.append(result(found)) if found[0] in RESULTS else self.samples.append(found[1:]))
        told, self.results = self.results, []
        return told

    def answer(self, name, sequence):
        kind, echoed, at, payload = self.frame()
        if echoed != sequence:
            raise Silence(f"answer to {echoed} instead of {sequence}")
        if kind == ERROR:
            raise Refused(payload)
        if kind != TYPES[name] | 0x80:
            raise Silence(f"type {kind:#x} instead of that of {name}")
        self.at = at
        fields = struct.unpack("<" + REPLIES[name], payload)
        return fields[0] if len(fields) == 1 else fields

    def ask(self, name, *fields, sequence=None, step=0):
        if sequence is None:
            self.sequence = sequence = (self.sequence + 1) & 0xffff
        self.send(wire(TYPES[name], sequence, step, struct.pack("<" + REQUESTS[name], *fields)))
        return self.answer(name, sequence)

    def refusal(self, name, *fields, **head):
        """The Refused that the request gets."""
        try:
            reply = self.ask(name, *fields, **head)
        except Refused as refused:
            return refused
        raise Silence(f"{name} was not refused but answered {reply}")

    def step(self, count=1, load_kind=KEEP, load=0.0, speed_kind=KEEP, speed=0.0):
        """Steps from where the plant stood at the last answer."""
        self.step_sequence = (self.step_sequence + 1) & 0xffff
        fields = self.ask("STEP", count, load_kind, speed_kind, load, speed, sequence=self.step_sequence, step=self.at)
        return dict(zip(STEP, fields))

    def status(self):
        return dict(zip(STATUS, self.ask("STATUS")))

    def set(self, may_reset=1, **values):
        """Parameters into force, all or none."""
        crc = self.ask("REVERT")
        for symbol, value in values.items():
            crc = self.ask("STAGE", SYMBOLS.index(symbol), value)[2]
        return self.ask("COMMIT", crc, may_reset)

    def snapshot(self):
        """The run as bytes."""
        run, size = b"", 1
        while len(run) < size:
            size, offset, piece = self.ask("SNAPSHOT", len(run))
            run += piece
        return run[:size]

    def restore(self, run):
        """Goes on with a run."""
        for offset in range(0, len(run), PIECE):
            self.ask("RESTORE", offset, len(run), run[offset:offset + PIECE])

    def preset(self, name):
        return self.ask("PRESET", PRESETS.index(name))
