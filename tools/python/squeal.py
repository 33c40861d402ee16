"""A brake that squeals, at the other end of a wire: client of the squeal firmware's binary link.

    import squeal

    with squeal.connect("host") as plant:                 # or /dev/ttyUSB0, unix:PATH, tcp:HOST:PORT, qemu:mps2-an386
        plant.preset("brake")
        plant.set(N1=3000, v0=0.1)                        # newton, m/s: all of them or none
        state = plant.step(640, N=1500)                   # 640 model steps under 1500 N
        print(state.step, state.x, state.propensity)      # metre; "unknown", "quiet", "watch" or "squeal"

Every value is in SI. Names, units, ranges and help of parameters and signals are the device's own: plant.parameters.
The plant moves only when it is told to, so that a run gives the same bits however slow the controller or the line is.
One thread at a time may use a plant. Needs Python 3.8 on a POSIX system. The wire: PROTOCOL.md, "The link".
"""
from __future__ import annotations

import contextlib
import difflib
import errno
import fcntl
import math
import os
import select
import shlex
import socket
import struct
import subprocess
import tempfile
import termios
import time
import weakref
import zlib
from collections import deque, namedtuple
from functools import cached_property
from typing import Any, Deque, Dict, Iterator, List, Mapping, NamedTuple, Optional, Sequence, Tuple, TypeVar, Union

__all__ = ["connect", "Plant", "Stream", "Study", "Axis", "State", "Status", "Verdict", "Point", "Border", "Tally",
           "Selftest", "Hello", "Parameter", "Signal", "Preset", "Committed", "Error", "Refused", "NoAnswer",
           "UnknownName", "PROFILE"]

VERSION = (1, 1)          # of the link that this client speaks: major, minor
PROFILE = "profile"       # in place of a force or a speed: give it back to the set's profile
BAUD = 921600             # of the link's UART, unless the board says otherwise

Value = Union[float, int, str]
Demand = Union[float, str, None]
Row = TypeVar("Row")
Words = Union[Sequence[str], Mapping[int, str]]


# --- What can go wrong ----------------------------------------------------------------------------------------------

class Error(Exception):
    """What this module raises."""


class UnknownName(Error, LookupError):
    """The device has no parameter, signal, preset or choice of this name."""


class Refused(Error):
    """The device said no, and changed nothing.

    request: what was asked, as PROTOCOL.md calls it. reason: the error's name. parameter: whose value or which field of
    the request is to blame, or None. expected: the number that would have been accepted, or None. low, high: the range
    that would have been accepted, in the parameter's unit, or None; of a choice, numbers into its choices.
    was_repeated: the request had been sent more than once.
    """

    def __init__(self, request: str, reason: str, parameter: Optional[str] = None, expected: Optional[int] = None,
                 low: Optional[float] = None, high: Optional[float] = None, unit: str = "") -> None:
        self.request, self.reason, self.parameter = request, reason, parameter
        self.expected, self.low, self.high = expected, low, high
        self.was_repeated = False
        super().__init__(f"{request} refused: {reason}" + (f": {parameter}" if parameter else "")
                         + (f", expected {expected}" if expected is not None else "")
                         + (f", accepted {low:.9g} .. {high:.9g} {unit}".rstrip() if low is not None else ""))


class NoAnswer(Error):
    """Nobody answers at this port. Whether a STEP or an order under way was obeyed is not known: status() will tell.

    port: as given to connect(). cause: what was seen. advice: what to try next.
    """

    def __init__(self, port: str, cause: str, advice: str) -> None:
        self.port, self.cause, self.advice = port, cause, advice
        super().__init__(f"no answer at {_printable(port)}: {_printable(cause)}; {_printable(advice)}")


# --- Words for numbers ----------------------------------------------------------------------------------------------

ERRORS = ("ok", "unknown-command", "usage", "unknown-name", "bad-number", "out-of-range", "needs-restart",
          "out-of-scale", "step-too-large", "not-served", "no-scale", "in-fault", "is-running", "line-too-long",
          "line-damaged", "line-overload", "selftest", "stopped", "busy", "bad-length", "unknown-type", "bad-sequence",
          "bad-step", "wrong-version", "wrong-crc", "safe-state", "wrong-layout", "bad-piece", "no-table", "table-full")
# These tell what would have been right; these requests blame a parameter, others a field, and so do these reasons.
EXPECTING = ("bad-length", "bad-sequence", "bad-step", "wrong-version", "wrong-crc", "wrong-layout", "bad-piece")
BLAMING = ("STAGE", "COMMIT", "PRESET", "RESET", "RESTORE")
OF_A_FIELD = ("wrong-layout", "bad-piece")

STATES = ("ready", "run", "fault")
MODES = {-1: "slip-", 0: "stick", 1: "slip+", 2: "fault"}
PROPENSITIES = ("unknown", "quiet", "watch", "squeal")
CLASSES = ("unsettled", "rest", "decaying", "growing", "forced", "stickslip", "cross", "limitcycle-slip",
           "limitcycle-stickslip", "aperiodic", "diverging")
INPUT_STATES = ("off", "fresh", "stale", "safe")
WORDS: Dict[str, Words] = {"mode": MODES, "propensity": PROPENSITIES, "input_state": INPUT_STATES}      # of signals
BANDS = ("none", "groan", "squeal")
ENDS = ("none", "whole", "squealed", "decayed", "diverged")
SIDES = ("quiet", "squeal")
QUIETS = ("none", "down", "up", "any")
KINDS = ("real", "whole", "choice", "bits")
CHANGES = ("live", "restart", "read only")


def _word(words: Words, number: int) -> str:
    """The number's name; of one that a newer device has added, the number itself."""
    table = words if isinstance(words, Mapping) else dict(enumerate(words))
    return table.get(number, f"#{number}")


def _printable(text: str) -> str:
    """The text with everything that a terminal might obey written as an escape."""
    return "".join(letter if " " <= letter <= "~" else letter.encode("unicode_escape").decode() if ord(letter) > 255
                   else f"\\x{ord(letter):02x}" for letter in text)


def _text(field: bytes) -> str:
    """A text[n] of the wire."""
    return _printable(field.split(b"\0", 1)[0].decode("latin-1"))


def _short(value: float) -> float:
    """The shortest decimal that is the same single-precision number: 0.1, not 0.10000000149011612."""
    decimals = (float(f"{value:.{digits}g}") for digits in range(1, 9))
    return next((decimal for decimal in decimals if _single(decimal) == value), value)


def _single(value: float) -> float:
    """The nearest f32; what is too large for one is an infinity, which the device will refuse."""
    try:
        return float(struct.unpack("<f", struct.pack("<f", value))[0])
    except OverflowError:
        return math.copysign(math.inf, value)


# --- What the device tells ------------------------------------------------------------------------------------------

class Hello(NamedTuple):
    """Who is speaking."""
    major: int                  # version of the link
    minor: int
    parameters_version: int     # of the tables
    signals_version: int
    commands_version: int
    parameters: int             # rows of the tables
    signals: int
    presets: int
    is_emulated: bool
    has_fpu: bool
    payload: int                # largest of a frame, bytes
    version: str
    build: str
    board: str
    core: str


class Parameter(NamedTuple):
    """One row of the device's table. default, low, high: in `unit`; a choice has names instead."""
    name: str
    unit: str
    type: str                   # real, whole, choice
    default: Value
    low: float
    high: float
    change: str                 # live, restart, read only: what a change asks of a plant that has moved
    help: str
    choices: Tuple[str, ...]
    row: int

    def number(self, value: Value) -> float:
        """The value as the wire wants it. A choice is given by its name, spp=64 by that number."""
        if not self.choices and not isinstance(value, str):
            return value
        name = value if isinstance(value, str) else f"{value:g}"
        if name not in self.choices:
            wanted = f"one of {', '.join(self.choices)}" if self.choices else "a number"
            raise UnknownName(f"{self.name} is not {_printable(name)!r} but {wanted}")
        return self.choices.index(name)

    def value(self, number: float) -> Value:
        """The wire's number as a user wants it."""
        if self.choices:
            return _word(self.choices, int(number))
        return int(number) if self.type == "whole" else _short(number)


class Signal(NamedTuple):
    """One row of the device's table of what can be looked at."""
    name: str
    unit: str
    type: str                   # real, whole, choice, bits
    help: str
    choices: Tuple[str, ...]
    row: int

    def value(self, field: bytes) -> Value:
        """The four bytes of the wire as a user wants them."""
        if self.type == "bits":
            return int.from_bytes(field, "little")
        number = float(struct.unpack("<f", field)[0])
        if not math.isfinite(number) or self.type == "real":
            return number
        words = WORDS.get(self.name, self.choices)
        return _word(words, int(number)) if words else int(number)


class Preset(NamedTuple):
    """A named set."""
    name: str
    help: str
    row: int


class Committed(NamedTuple):
    """A set that has come into force."""
    was_reset: bool             # the plant stands at step 0 again
    generation: int             # orders that the plant has taken
    crc: int                    # of the set in force


class State(NamedTuple):
    """The plant after a step()."""
    step: int                   # model steps since reset
    hash: int                   # of every state since reset: equal hashes, equal bits
    x: float                    # pad along the disc, m
    xd: float                   # m/s
    y: float                    # pad into the disc, m
    yd: float                   # m/s
    N: float                    # brake force held over the last step, N
    F: float                    # friction force on the pad, N
    v0: float                   # disc speed held over the last step, m/s
    mode: str                   # slip-, stick, slip+
    propensity: str             # unknown, quiet, watch, squeal
    class_: str                 # kind of motion, such as limitcycle-stickslip
    period: int                 # after how many normal periods or maxima it repeats; 0 where that makes no sense
    fault: bool                 # the plant has left its domain and is frozen since `step`
    clamped: bool               # a demand was held at a limit
    cut: bool                   # a stop on the console ended the steps at `step`
    stale: bool                 # the last demand is older than the parameter `stale` allows
    safe: bool                  # than `safe` allows: the brake force goes to 0, and only a start leads back


class Status(NamedTuple):
    """State and counters."""
    state: str                  # ready, run, fault
    step: int
    generation: int
    hash: int
    crc: int                    # of the set in force
    step_s: float               # physical time of a step
    sigma: float                # physical seconds per second of the wall, in free run
    events: int
    caps: int
    saturations: int
    lifted: int
    gap_held: int
    ticks: int
    overruns: int
    shed: int
    inputs_taken: int
    inputs_late: int
    inputs_clamped: int
    inputs_refused: int
    samples_offered: int
    samples_sent: int
    samples_dropped: int
    samples_waiting: int
    frames_accepted: int
    frames_damaged: int
    frames_too_long: int
    frames_badly_stuffed: int
    frames_too_short: int
    frames_wrong_crc: int
    bytes_of_no_frame: int
    requests_refused: int
    input_state: str            # off, fresh, stale, safe
    times_stale: int
    times_safe: int


class Verdict(NamedTuple):
    """Does it squeal, how, how loud, and what the closed form predicts. What makes no sense is nan."""
    propensity: str             # unknown, quiet, watch, squeal
    class_: str                 # kind of motion
    period: int
    band: str                   # none, groan, squeal
    predicted: str              # the closed form's propensity
    audible: bool
    bistable: bool              # quiet from rest, but a kick may start squeal
    amplitude_um: float
    velocity_mm_s: float
    velocity_mm_s_rms: float
    level_db: float             # re 1 nm/s
    acceleration_g: float
    frequency_hz: float
    level_dba_estimate: float
    growth_per_s: float
    growth_error_per_s: float
    stick: float                # share of the time
    slipminus: float
    predicted_growth_per_s: float
    predicted_touch_ratio: float
    onset_touch_ratio: float
    t_v10: float                # s, when the pad was first ten times as fast as the disc
    sigma: float


class Axis(NamedTuple):
    """Values of a parameter for a map, in its unit: in equal steps, or with log in equal ratios."""
    name: str
    first: Value
    last: Value
    points: int                 # 1 .. 256
    log: bool = False


class Point(NamedTuple):
    """One trial of a map. If the model cannot hold the set, error says why and the rest is empty: nan and unknown."""
    values: Tuple[Value, ...]   # of the parameters, axis by axis
    error: str                  # ok if there was a trial
    propensity: str
    class_: str
    period: int
    predicted: str
    end: str                    # whole, squealed, decayed, diverged
    loud: bool
    undecided: bool
    amplitude_um: float
    velocity_mm_s: float
    frequency_hz: float
    level_db: float
    growth_per_s: float
    growth_error_per_s: float
    predicted_growth_per_s: float
    periods: float


class Border(NamedTuple):
    """The nearest borders of squeal of one parameter, in its unit; nan where there is none."""
    name: str
    value: float                # of the set
    now: str                    # the set's own side: quiet, squeal
    quiets: str                 # the way to turn it for less squeal: none, down, up, any
    below: float
    below_quiet: float          # the two values between which the border lies
    below_squeal: float
    below_searched: float       # the farthest value tried where there is no border
    above: float
    above_quiet: float
    above_squeal: float
    above_searched: float


class Tally(NamedTuple):
    """What a study's trials came to."""
    reason: str                 # why it ended: ok, stopped
    results: int                # points, borders
    trials: int
    unknown: int
    quiet: int
    watch: int
    squeal: int
    loud: int
    undecided: int
    refused: int
    diverged: int
    caps: int
    saturations: int
    gap_held: int
    steps: int
    share: float                # of loud trials, of an occurrence, with its 95 % interval
    low: float
    high: float
    clamped: int


class Selftest(NamedTuple):
    """The firmware's own checks, on this device."""
    passed: int
    failed: Tuple[str, ...]     # names


# --- Frames ---------------------------------------------------------------------------------------------------------

class Request(NamedTuple):
    code: int
    name: str
    asks: str                   # layouts of payloads, as of struct, without the leading "<"
    tells: str
    fields: str                 # names of the request's fields


_SPAN = "transient window whole"
_PIECE = 232                    # bytes of a run that go over at a time
_POINTS = 16                    # points of a table that do

REQUESTS: Dict[str, Request] = {row.name: row for row in (
    Request(0x01, "HELLO", "BB", "BBHHHBBBBH16s32s24s16s", "major minor"),
    Request(0x02, "PING", "Q", "Q", "number"),
    Request(0x03, "STATUS", "", "BQIIIff24IBII", ""),
    Request(0x04, "DICTIONARY", "BB", "BBBHBBfff24s48s149s", "table index"),
    Request(0x05, "READ", "BB", "BB4s", "what index"),
    Request(0x06, "STAGE", "Bf", "BfI", "index value"),
    Request(0x07, "COMMIT", "IB", "IBI", "crc may_reset"),
    Request(0x08, "REVERT", "", "I", ""),
    Request(0x09, "PRESET", "B", "II", "index"),
    Request(0x0a, "RUN", "", "Q", ""),
    Request(0x0b, "STOP", "", "Q", ""),
    Request(0x0c, "RESET", "", "Q", ""),
    Request(0x0d, "STEP", "IBBff", "QI7fbBBBB", "n load-kind speed-kind load speed"),
    Request(0x0e, "INPUT", "QBBff", "B", "at load-kind speed-kind load speed"),
    Request(0x0f, "STREAM", "II", "IIH", "signals every"),
    Request(0x10, "SNAPSHOT", "H", f"HH{_PIECE}s", "offset"),
    Request(0x11, "RESTORE", f"HH{_PIECE}s", "HQ", "offset size piece"),
    Request(0x12, "SCAN", "BBffHBBffHHHB", "I", "name log first last points name log first last points " + _SPAN),
    Request(0x13, "MARGIN", "BfHHB", "I", "name within " + _SPAN),
    Request(0x14, "VERDICT", "", "6B16f", ""),
    Request(0x15, "SELFTEST", "", "BBI", ""),
    Request(0x16, "OCCURRENCE", "IIB4fHHB", "I", "trials seed uniform mu_s alpha c N " + _SPAN),
    Request(0x17, "TABLE", f"4B{2 * _POINTS}f", f"4BI{2 * _POINTS}f", "act table first count" + " t value" * _POINTS),
)}
_REPLY, _ERROR = 0x80, 0xff
_SAMPLE, _POINT, _BORDER, _STUDY_END = range(0x40, 0x44)        # come by themselves
RESULTS = {_POINT: struct.Struct("<Iff7B8f"), _BORDER: struct.Struct("<BBB9f"),
           _STUDY_END: struct.Struct("<BBI12IQ3fI")}
_REFUSAL = struct.Struct("<BBBIff")
_HEAD = struct.Struct("<BHI")
_PARAMETERS, _SIGNALS, _PRESETS, _SELFTESTS = range(4)          # tables of DICTIONARY
_NO_PARAMETER = 255
_TABLES = ("load", "speed")                                     # of breakpoints
_IN_FORCE, _STAGED, _NOW = range(3)                             # what READ reads
_KEEP, _PROFILE, _FIRST, _SECOND = range(4)                     # kinds of load and speed
_START = 0x80                                                   # beside a STEP's kind of load
_LONGEST = 7 + 240 + 4 + 2                                      # bytes of a stuffed frame before its 00


class Frame(NamedTuple):
    kind: int
    sequence: int
    step: int                   # low word of the plant's step counter
    payload: bytes


def _stuff(data: bytes) -> bytes:
    """Each piece between zeros behind its length + 1. Frames have no piece of 254 bytes."""
    return b"".join(bytes([len(piece) + 1]) + piece for piece in data.split(b"\0"))


def _unstuff(data: bytes) -> Optional[bytes]:
    pieces, at = [], 0
    while at < len(data):
        code = data[at]
        piece = data[at + 1:at + code]
        if len(piece) != code - 1:
            return None
        at += code
        pieces.append(piece + (b"\0" if code < 255 and at < len(data) else b""))
    return b"".join(pieces)


def encode(frame: Frame) -> bytes:
    data = _HEAD.pack(frame.kind, frame.sequence, frame.step) + frame.payload
    return _stuff(data + struct.pack("<I", zlib.crc32(data))) + b"\0"


def decode(line: bytes) -> Optional[Frame]:
    """What was before a 00, as a frame; None if it is none."""
    data = _unstuff(line)
    if data is None or len(data) < _HEAD.size + 4 or zlib.crc32(data[:-4]) != struct.unpack("<I", data[-4:])[0]:
        return None
    kind, sequence, step = _HEAD.unpack_from(data)
    return Frame(kind, sequence, step, data[_HEAD.size:-4])


# --- Ports ----------------------------------------------------------------------------------------------------------

class Port:
    """A line of bytes: a descriptor that never blocks, and what to say when nobody answers there."""

    def __init__(self, name: str, descriptor: int, advice: str) -> None:
        self.name, self.advice, self._descriptor = name, advice, descriptor
        os.set_blocking(descriptor, False)

    def close(self) -> None:
        os.close(self._descriptor)

    def _wait(self, event: int, until: float) -> bool:
        poll = select.poll()
        poll.register(self._descriptor, event)
        return bool(poll.poll(1000.0 * max(0.0, until - time.monotonic())))

    def _failed(self, cause: str) -> NoAnswer:
        return NoAnswer(self.name, cause, "the other end has gone: start it again and connect anew")

    def send(self, data: bytes, until: float) -> None:
        while data:
            if not self._wait(select.POLLOUT, until):
                raise NoAnswer(self.name, "the line takes no more bytes", self.advice)
            try:
                data = data[os.write(self._descriptor, data):]
            except BlockingIOError:
                continue
            except OSError as error:
                raise self._failed(error.strerror) from None

    def receive(self, until: float) -> bytes:
        """What has come, as soon as something has; b"" when nothing has until then (time.monotonic)."""
        if not self._wait(select.POLLIN, until):
            return b""
        try:
            data = os.read(self._descriptor, 65536)
        except BlockingIOError:
            return b""
        except OSError as error:
            raise self._failed(error.strerror) from None
        if not data:
            raise self._failed("the line was closed")
        return data


def _open_socket(name: str, family: int, address: Any, advice: str) -> Port:
    line = socket.socket(family, socket.SOCK_STREAM)
    try:
        line.settimeout(5.0)
        line.connect(address)
        if family != socket.AF_UNIX:
            line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    except OSError as error:
        line.close()
        raise NoAnswer(name, error.strerror or str(error), advice) from None
    return Port(name, line.detach(), "is another program connected there?")


def _open_tcp(name: str, rest: str) -> Port:
    host, _, number = rest.rpartition(":")
    advice = "is the firmware, or the bridge to it, listening there?"
    try:
        family, _, _, _, address = socket.getaddrinfo(host.strip("[]"), int(number), type=socket.SOCK_STREAM)[0]
    except ValueError:
        raise NoAnswer(name, "no port number", "write tcp:HOST:PORT") from None
    except OSError as error:
        raise NoAnswer(name, error.strerror or str(error), "is the host's name right?") from None
    return _open_socket(name, family, address, advice)


_SERIAL_ADVICE = {
    errno.ENOENT: "is it plugged in? ls /dev/ttyUSB* /dev/ttyACM* lists what is",
    errno.EACCES: "may you use it? ls -l tells its group, often dialout",
    errno.EBUSY: "another program has it: close that one",
    errno.ENOTTY: "name a serial line or a pseudo terminal",
}


def _open_serial(name: str, path: str, baud: int) -> Port:
    """Raw, 8N1, no flow control, for this process alone."""
    descriptor = -1
    try:
        descriptor = os.open(path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        _make_raw(descriptor, baud)
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        fcntl.ioctl(descriptor, termios.TIOCEXCL)
        termios.tcflush(descriptor, termios.TCIOFLUSH)
    except (OSError, termios.error) as error:
        if descriptor >= 0:
            os.close(descriptor)
        number = errno.EBUSY if isinstance(error, BlockingIOError) else error.args[0]
        raise NoAnswer(name, os.strerror(number), _SERIAL_ADVICE.get(number, "is it a serial line?")) from None
    except AttributeError:
        os.close(descriptor)
        raise NoAnswer(name, f"no line runs at {baud} baud", "give the board's, as baud=") from None
    return Port(name, descriptor, f"is it the board's second UART, the link, at {baud} baud, and the board on?")


def _make_raw(descriptor: int, baud: int) -> None:
    speed = getattr(termios, f"B{baud}")
    control = termios.tcgetattr(descriptor)[6]
    control[termios.VMIN], control[termios.VTIME] = 1, 0
    termios.tcsetattr(descriptor, termios.TCSANOW,
                      [0, 0, termios.CS8 | termios.CREAD | termios.CLOCAL, 0, speed, speed, control])


# --- Firmware that this process starts ------------------------------------------------------------------------------

def _find_tree(name: str, build: Optional[str]) -> str:
    here = os.path.dirname(os.path.abspath(__file__))
    tree = os.path.abspath(build or os.environ.get("SQUEAL_BUILD") or os.path.join(here, "..", ".."))
    if not os.path.isfile(os.path.join(tree, "Makefile")):
        raise NoAnswer(name, f"no source tree at {tree}", "give build= or SQUEAL_BUILD, the tree in which make was run")
    return tree


def _find_command(name: str, board: str, tree: str, link: str) -> List[str]:
    """The command line that starts the board's firmware with its link on a socket at `link`."""
    environment = {key: value for key, value in os.environ.items() if not key.startswith(("MAKE", "MFLAGS"))}
    made = subprocess.run(["make", "-s", "--no-print-directory", f"BOARD={board}", f"LINK={link}", "command"], cwd=tree,
                          env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if made.returncode != 0:
        said = made.stderr.strip().splitlines() or ["make command failed"]
        raise NoAnswer(name, said[0], "name a board of this tree")
    command = shlex.split(made.stdout.split(": ", 1)[1])
    if not os.path.exists(os.path.join(tree, command[-1])):
        raise NoAnswer(name, f"{command[-1]} has not been built", f"run make BOARD={board} in {tree}")
    return command


def _reap(process: "subprocess.Popen[bytes]") -> None:
    process.kill()
    process.communicate()


def _spawn(name: str, board: str, build: Optional[str], stack: contextlib.ExitStack) -> Port:
    """Starts the board's firmware; the stack ends it. Its console stays silent and gets no line."""
    tree = _find_tree(name, build)
    folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="squeal-"))
    link = os.path.join(folder, "link")
    command = _find_command(name, board, tree, link)
    with open(os.path.join(folder, "stderr"), "w+b") as log:
        try:
            process = subprocess.Popen(command, cwd=tree, env={**os.environ, "SQUEAL_LINK": f"unix:{link}"},
                                       stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=log,
                                       start_new_session=True)
        except OSError as error:
            raise NoAnswer(name, f"{command[0]}: {error.strerror}", "install it: tools/setup tells how") from None
        stack.callback(_reap, process)
        until = time.monotonic() + 10.0
        while process.poll() is None and time.monotonic() < until:
            with contextlib.suppress(NoAnswer):
                return _open_socket(name, socket.AF_UNIX, link, "")
            time.sleep(0.01)
        log.seek(0)
        said = log.read().decode("latin-1").strip().splitlines()
    cause = "the firmware ended" if process.poll() is not None else "the firmware opened no link in 10 s"
    raise NoAnswer(name, f"{cause}: {said[-1]}" if said else cause, f"start it by hand: {shlex.join(command)}")


def open_port(name: str, baud: int, build: Optional[str], stack: contextlib.ExitStack) -> Port:
    kind, _, rest = name.partition(":")
    if kind == "unix":
        return _open_socket(name, socket.AF_UNIX, rest, "is the firmware running, with its link there?")
    if kind == "tcp":
        return _open_tcp(name, rest)
    if kind == "pty" or name.startswith("/"):
        return _open_serial(name, rest if kind == "pty" else name, baud)
    if name == "host" or kind == "qemu" and rest:
        return _spawn(name, rest or "host", build, stack)
    raise NoAnswer(name, "no port has such a name",
                   "give host, qemu:BOARD, /dev/ttyUSB0, pty:PATH, unix:PATH or tcp:HOST:PORT")


# --- Requests and replies -------------------------------------------------------------------------------------------

class Refusal(Exception):
    """An ERROR, as it came."""

    def __init__(self, payload: bytes) -> None:
        super().__init__()
        _, self.reason, self.index, self.expected, self.low, self.high = _REFUSAL.unpack(payload)
        self.was_repeated = False               # the request


class Link:
    """Frames out, frames in: asks again when no reply comes, sets samples aside, follows the plant's step."""

    def __init__(self, port: Port, timeout_s: float, patience_s: float) -> None:
        self.port, self.timeout_s, self.patience_s = port, timeout_s, patience_s
        self.step = 0                           # low word of the plant's step counter, as the last reply told
        self.samples: Deque[Frame] = deque()
        self.results: Deque[Frame] = deque()    # of a study
        self._partial = b""
        self._frames: Deque[Frame] = deque()
        self._heard, self._good, self._printable = 0, 0, 0

    def ask(self, request: Request, sequence: int, fields: Sequence[Any], extra_s: float = 0.0) -> Tuple[Any, ...]:
        """The reply's fields. extra_s: what the request may take by itself. Raises Refusal, NoAnswer."""
        try:
            payload = struct.pack("<" + request.asks, *fields)
        except struct.error as error:
            raise ValueError(f"{request.name}: {error}") from None
        line = encode(Frame(request.code, sequence, self.step, payload))
        now = time.monotonic()
        until, pause, tries = now + self.patience_s + extra_s, self.timeout_s, 0
        while now < until:
            # The leading 00 rids the line of half a frame.
            self.port.send(b"\0" + line, until)
            tries += 1
            try:
                told = self.reply(request, sequence, min(until, now + pause))
            except Refusal as refusal:
                refusal.was_repeated = tries > 1
                raise
            if told is not None:
                return told
            pause *= 2
            now = time.monotonic()
        raise self._no_answer(request, tries)

    def reply(self, request: Request, sequence: int, until: float) -> Optional[Tuple[Any, ...]]:
        """The fields of the request's reply, None if it does not come until then. Late ones to others are skipped."""
        while True:
            frame = self.listen(until)
            if frame is None:
                return None
            if self.keep(frame):
                pass
            elif frame.sequence == sequence and frame.kind == request.code + _REPLY:
                self.step = frame.step
                return self._unpack(request, frame.payload)
            elif frame.sequence == sequence and _is_error_of(frame, request):
                self.step = frame.step
                raise Refusal(frame.payload)
            if not self._frames and time.monotonic() >= until:
                return None

    def keep(self, frame: Frame) -> bool:
        """Sets aside what comes by itself."""
        if frame.kind == _SAMPLE:
            self.samples.append(frame)
        elif frame.kind in RESULTS and len(frame.payload) == RESULTS[frame.kind].size:
            self.results.append(frame)
        return frame.kind < _REPLY

    def _unpack(self, request: Request, payload: bytes) -> Tuple[Any, ...]:
        layout = struct.Struct("<" + request.tells)
        if len(payload) != layout.size:
            raise Error(f"{_printable(self.port.name)}: the reply to {request.name} has {len(payload)} bytes "
                        f"instead of {layout.size}")
        return layout.unpack(payload)

    def listen(self, until: float) -> Optional[Frame]:
        """The next frame, None if none comes until then."""
        while not self._frames:
            self._take(self.port.receive(until))
            if not self._frames and time.monotonic() >= until:
                return None
        return self._frames.popleft()

    def _take(self, data: bytes) -> None:
        self._heard += len(data)
        if not self._good:
            self._printable += sum(32 <= byte < 127 or byte in b"\r\n" for byte in data)
        *lines, self._partial = (self._partial + data).split(b"\0")
        for line in lines:
            self._sort(line, decode(line))
        if len(self._partial) > _LONGEST:
            self._partial = b""                 # the rest of it will be no frame either

    def _sort(self, line: bytes, frame: Optional[Frame]) -> None:
        if frame:
            self._good += 1
            self._frames.append(frame)

    def _no_answer(self, request: Request, tries: int) -> NoAnswer:
        asked = f"{request.name} was sent {tries} times"
        if not self._heard:
            return NoAnswer(self.port.name, f"{asked} and not a byte came back", self.port.advice)
        if not self._good and self._printable > 0.9 * self._heard:
            return NoAnswer(self.port.name, f"{asked} and text came back",
                            "this is the console: the link is the other UART")
        if not self._good:
            return NoAnswer(self.port.name, f"{asked} and {self._heard} bytes that are no frames came back",
                            "is it the link's UART, and at its baud rate?")
        return NoAnswer(self.port.name, f"{asked} and no reply came, though the line has carried {self._good} frames",
                        "is the board still on? connect anew")


def _is_error_of(frame: Frame, request: Request) -> bool:
    return frame.kind == _ERROR and len(frame.payload) == _REFUSAL.size and frame.payload[0] == request.code


# --- The plant ------------------------------------------------------------------------------------------------------

class Stream:
    """Samples as they come: iterate over it.

    Each is a named tuple of `step` and the signals. In lockstep the iteration ends with the last sample of the steps
    made so far and may be taken up again after the next step(); in free run it waits for the next one and ends once the
    plant stands still. `lost`: samples that were due before the last one and did not come. `every`: steps from one to
    the next. `smallest`: the `every` that 80 % of the line can carry in free run. `bytes`: what a sample takes on the
    line.
    """

    def __init__(self, plant: "Plant", signals: List[Signal], every: int, smallest: int, size: int) -> None:
        self.every, self.smallest, self.bytes, self.lost = every, smallest, size, 0
        self.is_open = True
        self._plant, self._due, self._last_step = plant, 0, plant._at
        self._in_order = sorted(signals, key=lambda signal: signal.row)
        self._sample = namedtuple("Sample", ["step"] + [signal.name for signal in signals])  # type: ignore[misc]

    def __iter__(self) -> Iterator[Any]:
        return self

    def __next__(self) -> Any:
        frame = self._plant._next_sample(self)
        while len(frame.payload) != 4 * len(self._in_order):
            frame = self._plant._next_sample(self)
        step = self._plant._whole_step(frame.step)
        self.lost += self._count_lost(frame.sequence, step)
        self._due, self._last_step = (frame.sequence + 1) & 0xffff, step
        values = {signal.name: signal.value(frame.payload[4 * at:4 * at + 4])
                  for at, signal in enumerate(self._in_order)}
        return self._sample(step=step, **values)

    def _count_lost(self, sequence: int, step: int) -> int:
        """The sequence tells the number but for multiples of 65536, the step tells these, unless there was a reset."""
        lost = (sequence - self._due) & 0xffff
        by_step = (step - self._last_step) // max(1, self.every) - 1
        return lost + max(0, by_step - lost + 0x8000) // 0x10000 * 0x10000

    def end(self) -> None:
        """No more samples; those that have come can still be read."""
        self._plant._end_stream(self)

    def __enter__(self) -> "Stream":
        return self

    def __exit__(self, _: object, error: Optional[BaseException], __: object) -> None:
        if not isinstance(error, NoAnswer):
            self.end()


class Study:
    """Trials of sets on the device beside the plant, which goes on undisturbed: iterate over its results as they come.

    The plant may be asked and stepped between two of them. promised: the results to come; of an occurrence the trials.
    tally: what they came to, once the iteration has ended.
    """

    def __init__(self, plant: "Plant", name: str, promised: int, rows: Sequence[Parameter]) -> None:
        self.promised = promised
        self.tally: Optional[Tally] = None
        self._plant, self._name, self._sequence, self._rows = plant, name, plant._sequence, rows

    def __iter__(self) -> Iterator[Any]:
        return self

    def __next__(self) -> Any:
        if self.tally:
            raise StopIteration
        frame = self._plant._next_result(self._sequence)
        fields = RESULTS[frame.kind].unpack(frame.payload)
        if frame.kind == _POINT:
            return self._point(*fields)
        if frame.kind == _BORDER:
            return self._border(*fields)
        self.tally = Tally(_word(ERRORS, fields[1]), *fields[2:])
        if self.tally.reason not in ("ok", "stopped"):
            raise Refused(self._name, self.tally.reason)
        raise StopIteration

    def _point(self, _: int, first: float, second: float, error: int, propensity: int, kind: int, period: int,
               predicted: int, end: int, flags: int, *measured: float) -> Point:
        values = tuple(row.value(value) for row, value in zip(self._rows, (first, second)))
        return Point(values, _word(ERRORS, error), _word(PROPENSITIES, propensity), _word(CLASSES, kind), period,
                     _word(PROPENSITIES, predicted), _word(ENDS, end), bool(flags & 1), bool(flags & 2), *measured)

    def _border(self, row: int, now: int, quiets: int, value: float, *measured: float) -> Border:
        names = list(self._plant.parameters)
        return Border(names[row], _short(value), _word(SIDES, now), _word(QUIETS, quiets), *measured)

    def stop(self) -> None:
        """No more trials; what has been found can still be read. The plant goes on, unless the line loses the reply."""
        if not self.tally:
            self._plant._ask("STOP")


class Plant:
    """A brake at the other end of a link. Made by connect()."""

    def __init__(self, link: Link, stack: contextlib.ExitStack) -> None:
        self._link = link
        self._sequence = 0                      # of all but STEP
        self._step_sequence = 0                 # the next STEP's: its own count
        self._is_unsure = False                 # of what became of the last STEP, and of what is still to come of it
        self._at = 0                            # the plant's step counter, as last told
        self._steps_per_s = 0.0                 # that the board makes; 0: to be asked
        self._is_running = False                # freely, or samples of such a run still wait on the device
        self._stream: Optional[Stream] = None
        self._current: Optional[Study] = None
        self.close = weakref.finalize(self, stack.close)

    def __enter__(self) -> "Plant":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    # --- One request ---

    def _ask(self, name: str, *fields: Any, extra_s: float = 0.0) -> Tuple[Any, ...]:
        """Any request but STEP, by name and fields: the fields of the reply. extra_s: what it takes by itself."""
        if not self.close.alive:
            raise Error("this plant has been closed")
        request = REQUESTS[name]
        self._sequence = (self._sequence + 1) & 0xffff
        try:
            return self._link.ask(request, self._sequence, fields, extra_s)
        except Refusal as refusal:
            raise self._refused(request, refusal) from None

    def _refused(self, request: Request, refusal: Refusal) -> Refused:
        reason = _word(ERRORS, refusal.reason)
        has_range = refusal.low != 0.0 or refusal.high != 0.0
        blamed, unit = self._blame(request, reason, refusal.index)
        refused = Refused(request.name, reason, blamed, refusal.expected if reason in EXPECTING else None,
                          _short(refusal.low) if has_range else None, _short(refusal.high) if has_range else None, unit)
        refused.was_repeated = refusal.was_repeated
        return refused

    def _blame(self, request: Request, reason: str, index: int) -> Tuple[Optional[str], str]:
        """What the index of an ERROR means, and its unit."""
        if request.name not in BLAMING or reason in OF_A_FIELD:
            return dict(enumerate(request.fields.split())).get(index), ""
        row = dict(enumerate(self.parameters.values())).get(index)
        return (row.name, row.unit or "of " + "|".join(row.choices)) if row else (None, "")

    @cached_property
    def hello(self) -> Hello:
        """Who is speaking. The device forgets the last STEP: the next one starts a new count."""
        fields = self._ask("HELLO", *VERSION)
        flags = fields[8]
        return Hello._make((*fields[:8], bool(flags & 1), bool(flags & 2), fields[9], *map(_text, fields[10:])))

    # --- Tables of the device ---

    def _rows(self, table: int, count: int) -> Iterator[Tuple[Any, ...]]:
        for index in range(count):
            yield self._ask("DICTIONARY", table, index)

    @cached_property
    def parameters(self) -> Dict[str, Parameter]:
        """The device's parameters by name, in the order of its table."""
        found = {}
        for row in self._rows(_PARAMETERS, self.hello.parameters):
            name, unit, text = map(_text, row[9:])
            choices = tuple(unit.split("|")) if _word(KINDS, row[4]) == "choice" else ()
            default, low, high = map(_short, row[6:9])
            found[name] = Parameter(name, "" if choices else unit, _word(KINDS, row[4]),
                                    choices[int(default)] if choices else default, low, high,
                                    _word(CHANGES, row[5]), text, choices, row[1])
        return found

    @cached_property
    def signals(self) -> Dict[str, Signal]:
        """What can be looked at, by name."""
        found = {}
        for row in self._rows(_SIGNALS, self.hello.signals):
            name, unit, text = map(_text, row[9:])
            choices = tuple(unit.split("|")) if _word(KINDS, row[4]) == "choice" else ()
            found[name] = Signal(name, "" if choices else unit, _word(KINDS, row[4]), text, choices, row[1])
        return found

    @cached_property
    def presets(self) -> Dict[str, Preset]:
        """The named sets."""
        rows = self._rows(_PRESETS, self.hello.presets)
        return {_text(row[9]): Preset(_text(row[9]), _text(row[11]), row[1]) for row in rows}

    # --- The set ---

    def get(self, name: str) -> Value:
        """A parameter in force: a number in its unit, of a choice the name."""
        row = _find(self.parameters, name, "parameter")
        return row.value(struct.unpack("<f", self._ask("READ", _IN_FORCE, row.row)[2])[0])

    def _stage_table(self, table: int, points: Sequence[Tuple[float, float]]) -> int:
        crc = 0
        for first in range(0, max(len(points), 1), _POINTS):
            piece = [number for point in points[first:first + _POINTS] for number in point]
            crc = self._ask("TABLE", 2, table, first, len(piece) // 2, *piece, *[0.0] * (2 * _POINTS - len(piece)))[4]
        return crc

    def set(self, values: Mapping[str, Value] = {}, /, *, may_reset: bool = False,
            tables: Optional[Mapping[str, Sequence[Tuple[float, float]]]] = None, **named: Value) -> Committed:
        """Changes parameters, all of them or none; each in its unit, a choice by name or number. tables: new breakpoints
        (t, value) of load="table" and speed="table", by these names.

        At step 0 this is a reset, later live parameters change between two steps. may_reset: others may take a plant
        that has moved, and stands, back to step 0. Raises Refused with the parameter and the range that is free to it.
        """
        rows = [(_find(self.parameters, name, "parameter"), value) for name, value in {**values, **named}.items()]
        numbers = [(row.row, _single(row.number(value))) for row, value in rows]
        self._steps_per_s = 0.0
        crc = self._ask("REVERT")[0]
        try:
            for index, number in numbers:
                crc = self._ask("STAGE", index, number)[2]
            for table, points in (tables or {}).items():
                crc = self._stage_table(_TABLES.index(table), points)
            crc, was_reset, generation = self._ask("COMMIT", crc, may_reset)
        except Refused:
            self._ask("REVERT")
            raise
        if was_reset:
            self._at = 0
        return Committed(bool(was_reset), generation, crc)

    def table(self, name: str) -> List[Tuple[float, float]]:
        """The breakpoints (t, value) of load="table" or of speed="table" in force: name is load or speed."""
        points: List[Tuple[float, float]] = []
        while True:
            _, _, count, length, _, *numbers = self._ask("TABLE", 0, _TABLES.index(name), len(points), 0, *[0.0] * 2 * _POINTS)
            points += list(zip(numbers[0::2], numbers[1::2]))[:count]
            if not count or len(points) >= length:
                return points

    def preset(self, name: str) -> Committed:
        """Loads a named set: every parameter. Stops and resets the plant."""
        row = _find(self.presets, name, "preset")
        self._steps_per_s, self._is_running = 0.0, False
        crc, generation = self._ask("PRESET", row.row)
        self._at = 0
        return Committed(True, generation, crc)

    # --- Motion ---

    def step(self, n: int, *, N: Demand = None, pressure: Demand = None, v0: Demand = None, vehicle: Demand = None,
             start: bool = False) -> State:
        """Makes n model steps (1 .. 1000000) and tells the state.

        From the first of them on holds the force N in newton or the pressure in Pa, the disc's speed at the pad v0 or
        that of the vehicle in m/s; what is not named stays as it was, PROFILE gives it back to the set. If no reply
        comes the same frame is sent again, and is obeyed once however often it arrives. start: leaves the safe state.
        """
        if self._steps_per_s == 0.0:
            self.status()
        load, *others = _demand(N, pressure, v0, vehicle)
        reply = self._make_steps(n, load | _START if start else load, *others)
        step, counted, x, xd, y, yd, force, friction, speed, mode, propensity, kind, period, flags = reply
        self._at, self._is_running = step, False
        return State(step, counted, x, xd, y, yd, force, friction, speed, _word(MODES, mode),
                     _word(PROPENSITIES, propensity), _word(CLASSES, kind), period,
                     fault=bool(flags & 1), clamped=bool(flags & 2), cut=bool(flags & 4), stale=bool(flags & 8),
                     safe=bool(flags & 16))

    def _make_steps(self, n: int, *demand: Any) -> Tuple[Any, ...]:
        request, may_be_behind = REQUESTS["STEP"], self._is_unsure
        while True:
            if self._is_unsure:
                # A second answer to the last STEP may be on its way, and would be taken for this one's.
                self._ask("PING", 0)
            self._is_unsure = True
            try:
                reply = self._link.ask(request, self._step_sequence, (n, *demand), extra_s=n / self._steps_per_s)
            except Refusal as refusal:
                self._is_unsure = refusal.was_repeated
                if may_be_behind and _word(ERRORS, refusal.reason) == "bad-sequence":
                    self._step_sequence, may_be_behind = refusal.expected & 0xffff, False
                    continue
                raise self._refused(request, refusal) from None
            self._is_unsure, self._step_sequence = False, (self._step_sequence + 1) & 0xffff
            return reply

    def input(self, at: int = 0, *, N: Demand = None, pressure: Demand = None, v0: Demand = None,
              vehicle: Demand = None) -> bool:
        """Holds force and speed, as step() does, from step `at` on (0: from the next one). True: held at a limit."""
        load, speed, *values = _demand(N, pressure, v0, vehicle)
        return bool(self._ask("INPUT", at, load, speed, *values)[0])

    def run(self) -> int:
        """Lets the plant step freely until stop(), and leaves the safe state; the step where it began."""
        self._at, = self._ask("RUN")
        self._is_running = True
        return self._at

    def stop(self) -> int:
        """The plant stands still, and a study under way ends; the step where it stands."""
        if self._current and not self._current.tally:
            self._ask("STOP")                   # ends the study alone
        self._at, = self._ask("STOP")
        self._is_running = False
        return self._at

    def reset(self) -> int:
        """Back to step 0 with the same set; leaves a fault."""
        self._at, = self._ask("RESET")
        self._is_running = False
        return self._at

    # --- A run to go on with ---

    def snapshot(self) -> bytes:
        """The whole run of a plant that stands: set, plant, detector, counters, what is held and what waits."""
        run, size = b"", 1
        while len(run) < size:
            size, offset, piece = self._ask("SNAPSHOT", len(run))
            run += piece
        return run[:size]

    def restore(self, run: bytes) -> int:
        """Goes on with a run, with the same bits on any board of the same firmware; the step where it stood."""
        self._steps_per_s, self._is_running = 0.0, False
        for offset in range(0, len(run), _PIECE):
            _, self._at = self._ask("RESTORE", offset, len(run), run[offset:offset + _PIECE])
        return self._at

    # --- Looking ---

    def read(self, name: str) -> Value:
        """A signal now."""
        row = _find(self.signals, name, "signal")
        return row.value(self._ask("READ", _NOW, row.row)[2])

    def status(self) -> Status:
        """State and counters."""
        fields = self._ask("STATUS")
        status = Status._make((_word(STATES, fields[0]), *fields[1:-3], _word(INPUT_STATES, fields[-3]), *fields[-2:]))
        self._at, self._is_running = status.step, status.state == "run" or status.samples_waiting > 0
        self._steps_per_s = max(1.0, status.sigma / status.step_s) if status.step_s > 0 else 1.0
        return status

    def ping(self) -> float:
        """Seconds there and back."""
        began = time.monotonic()
        number = time.monotonic_ns()
        if self._ask("PING", number)[0] != number:
            raise Error(f"{self._link.port.name}: PING brought other bytes back")
        return time.monotonic() - began

    def stream(self, signals: Sequence[str], every: int = 1) -> Stream:
        """Samples of these signals each `every` steps, in place of those before; `step` comes with each of them."""
        rows = [_find(self.signals, name, "signal") for name in dict.fromkeys(signals) if name != "step"]
        if self._stream:
            self._ask("STREAM", 0, 0)
        self._stream = None
        self._link.samples.clear()
        self.status()
        bits = sum(1 << row.row for row in rows)
        self._stream = Stream(self, rows, *self._ask("STREAM", bits, every))
        return self._stream

    # --- Judging ---

    def verdict(self) -> Verdict:
        """Does it squeal, how, how loud."""
        propensity, kind, period, band, predicted, flags, *measured = self._ask("VERDICT")
        return Verdict(_word(PROPENSITIES, propensity), _word(CLASSES, kind), period, _word(BANDS, band),
                       _word(PROPENSITIES, predicted), bool(flags & 1), bool(flags & 2), *measured)

    def selftest(self) -> Selftest:
        """Lets the firmware check itself."""
        passed, _, failed = self._ask("SELFTEST", extra_s=60.0)
        rows = [row for row in range(32) if failed >> row & 1]
        return Selftest(passed, tuple(_text(self._ask("DICTIONARY", _SELFTESTS, row)[9]) for row in rows))

    def scan(self, *axes: Axis, transient: int = 360, window: int = 40, whole: bool = False) -> Study:
        """A map over one parameter or two: a Point for each set, the first axis fastest.

        transient, window: normal periods that pass, and over which is measured. whole: no trial is cut short where its
        end is certain.
        """
        rows = [_find(self.parameters, axis.name, "parameter") for axis in axes]
        fields = [(row.row, axis.log, row.number(axis.first), row.number(axis.last), axis.points)
                  for row, axis in zip(rows, axes)]
        if not 1 <= len(fields) <= 2:
            raise ValueError("a map has one axis or two")
        first, second = (*fields, (_NO_PARAMETER, False, 0.0, 0.0, 0))[:2]
        return self._study("SCAN", rows, *first, *second, *_span(transient, window, whole))

    def margin(self, name: Optional[str] = None, *, within: float = 16.0, transient: int = 1600, window: int = 40,
               whole: bool = False) -> Study:
        """The nearest borders of squeal of a parameter, or of each that has some: a Border for each.

        Searched from value/within to value x within.
        """
        row = _find(self.parameters, name, "parameter").row if name else _NO_PARAMETER
        return self._study("MARGIN", (), row, within, *_span(transient, window, whole))

    def occurrence(self, trials: int, *, seed: int = 0, uniform: bool = False, mu_s: float = 0.0, alpha: float = 0.0,
                   c: float = 0.0, N: float = 0.0, transient: int = 1600, window: int = 40,
                   whole: bool = False) -> Tally:
        """The share of squeal when these are scattered by so much of their values; waits for the end of the trials.

        Standard deviation, or half width if uniform; if none is given all of them by 0.1.
        """
        scatter = (mu_s, alpha, c, N) if mu_s or alpha or c or N else (0.1,) * 4
        study = self._study("OCCURRENCE", (), trials, seed, uniform, *scatter, *_span(transient, window, whole))
        for _ in study:
            pass
        assert study.tally
        return study.tally

    def _study(self, name: str, rows: Sequence[Parameter], *fields: Any) -> Study:
        self._link.results.clear()
        try:
            promised, = self._ask(name, *fields)
        except Refused as refused:
            # The second of two may have met the study that the first one began.
            if refused.reason != "busy" or not refused.was_repeated or not self._hears_of(self._sequence):
                raise
            promised = 0
        self._current = Study(self, name, promised, rows)
        return self._current

    def _hears_of(self, sequence: int) -> bool:
        """Does the study of this request tell a result within the time that a reply may take?"""
        until = time.monotonic() + self._link.patience_s
        while not any(result.sequence == sequence for result in self._link.results):
            frame = self._link.listen(until)
            if frame is None:
                return False
            self._link.keep(frame)
        return True

    def _next_result(self, sequence: int) -> Frame:
        """The next one of this study, however long a trial takes; asks now and then whether anybody is there."""
        while True:
            while self._link.results:
                result = self._link.results.popleft()
                if result.sequence == sequence:
                    return result
            frame = self._link.listen(time.monotonic() + self._link.timeout_s)
            if frame:
                self._link.keep(frame)
            else:
                self.ping()

    def _end_stream(self, stream: Stream) -> None:
        if stream is self._stream and stream.is_open:
            self._ask("STREAM", 0, 0)
            stream.is_open = False

    def _next_sample(self, stream: Stream) -> Frame:
        """The stream's next; StopIteration when there is none and the plant stands still."""
        if stream is not self._stream:
            raise StopIteration
        while not self._link.samples:
            if not self._is_running or not stream.is_open:
                raise StopIteration
            frame = self._link.listen(time.monotonic() + self._link.timeout_s)
            if frame is None:
                self.status()
            else:
                self._link.keep(frame)
        frame = self._link.samples.popleft()
        if self._is_running:
            self._at = self._whole_step(frame.step)
        return frame

    def _whole_step(self, low: int) -> int:
        """The step counter of which this is the low word: the one nearest to where the plant was last seen."""
        return self._at + (low - self._at + 0x80000000) % 0x100000000 - 0x80000000


def _span(transient: int, window: int, whole: bool) -> Tuple[int, int, int]:
    return transient, window, int(whole)


def _find(table: Mapping[str, Row], name: str, kind: str) -> Row:
    if name not in table:
        close = difflib.get_close_matches(name, table, n=3, cutoff=0.4)
        raise UnknownName(f"no {kind} is called {_printable(name)!r}" + (f": {', '.join(close)}?" if close else ""))
    return table[name]


def _demand(force: Demand, pressure: Demand, disc: Demand, vehicle: Demand) -> Tuple[int, int, float, float]:
    """Kind of load, kind of speed, load, speed."""
    load_kind, load = _choose("N", force, "pressure", pressure)
    speed_kind, speed = _choose("v0", disc, "vehicle", vehicle)
    return load_kind, speed_kind, load, speed


def _choose(first_name: str, first: Demand, second_name: str, second: Demand) -> Tuple[int, float]:
    if first is not None and second is not None:
        raise ValueError(f"{first_name} or {second_name}, not both")
    value = first if first is not None else second
    if value is None:
        return _KEEP, 0.0
    if isinstance(value, str):
        if value != PROFILE:
            raise ValueError(f"{first_name} and {second_name} are numbers or {PROFILE!r}")
        return _PROFILE, 0.0
    return (_FIRST if first is not None else _SECOND), _single(value)


def connect(port: str, *, baud: int = BAUD, build: Optional[str] = None, timeout_s: float = 0.5,
            patience_s: float = 10.0) -> Plant:
    """The plant at this port, greeted; a context manager, which closes the port and ends what was started.

    port: /dev/ttyUSB0 or pty:/dev/pts/3 (a serial line, raw, 8N1 at `baud`), unix:PATH, tcp:HOST:PORT, or a firmware
    to be started: host, qemu:mps2-an386. build: the source tree in which make was run, else SQUEAL_BUILD, else the one
    that this file lies in. timeout_s: without a reply for so long a request is sent again, then after twice that, and
    so on; patience_s: NoAnswer is raised after so long, and for a step the time that it takes by itself.
    """
    with contextlib.ExitStack() as stack:
        line = open_port(port, baud, build, stack)
        stack.callback(line.close)
        plant = Plant(Link(line, timeout_s, patience_s), stack.pop_all())
    try:
        plant.hello  # greets
    except Error:
        plant.close()
        raise
    return plant
