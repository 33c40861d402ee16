"""What the tests say to the link beyond tools/python/squeal.py, which they speak it with: raw frames, requests that nobody
would make, no second try. Names and numbers are those of the tables that the firmware is made of."""
import contextlib
import os
import struct
import sys
import time
from collections import deque

SOURCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "src")
sys.path.insert(0, os.path.join(SOURCES, "..", "tools", "python"))
import squeal  # noqa: E402


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

REQUESTS = {name: request.asks for name, request in squeal.REQUESTS.items()}
STATUS = ("state step generation hash set_crc step_s sigma events caps saturations lifted gap_held ticks overruns shed inputs late "
          "clamped inputs_refused offered sent dropped waiting accepted damaged too_long bad_cobs too_short bad_crc garbage "
          "refused input_state times_stale times_safe").split()
STEP = "step hash x xd y yd load friction v0 mode propensity motion period flags".split()
KEEP, PROFILE, FORCE, PRESSURE = range(4)
KEEP, PROFILE, DISC, VEHICLE = range(4)
VERDICT = ("propensity motion period band predicted flags amplitude_um velocity_mm_s velocity_mm_s_rms level_db acceleration_g "
           "frequency_hz level_dba_estimate growth_per_s growth_error_per_s stick slipminus predicted_growth_per_s "
           "predicted_touch_ratio onset_touch_ratio t_v10 sigma").split()
SAMPLE, NO_PARAMETER = 0x40, 255
PIECE, STARTS = 232, 0x80

# What a study tells by itself: name and fields by the type of the frame.
RESULTS = {
    0x41: ("POINT", "point first second error propensity motion period predicted end flags amplitude_um velocity_mm_s "
           "frequency_hz level_db growth_per_s growth_error_per_s predicted_growth_per_s periods"),
    0x42: ("BORDER", "parameter now quiets value below below_quiet below_squeal below_searched "
           "above above_quiet above_squeal above_searched"),
    0x43: ("STUDY_END", "request reason results trials unknown quiet watch squeal loud undecided refused diverged caps "
           "saturations gap_held steps share low high clamped"),
}


class Silence(Exception):
    """No answer in time, or none that makes sense."""


class Refused(Exception):
    """ERROR, with its fields as they came."""

    def __init__(self, refusal):
        self.index, self.expected, self.low, self.high = refusal.index, refusal.expected, refusal.low, refusal.high
        self.reason = ERRORS[refusal.reason]
        super().__init__(f"{self.reason} index={self.index} expected={self.expected:#x} {self.low} .. {self.high}")


def wire(kind, sequence, step, payload=b""):
    """A frame as it goes over the line."""
    return squeal.encode(squeal.Frame(kind, sequence, step & 0xffffffff, payload))


unwire = squeal.decode


def result(frame):
    """The fields of a frame that a study has sent."""
    name, names = RESULTS[frame.kind]
    fields = squeal.RESULTS[frame.kind].unpack(frame.payload)
    return dict(zip(names.split(), fields), frame=name, sequence=frame.sequence, step=frame.step)


class RawLink(squeal.Link):
    """Keeps the bytes of the frame that was heard last, and bears nothing from the firmware that is no frame."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.raw, self.lines = b"", deque()

    def _sort(self, line, frame):
        if frame is None and line:
            raise Silence(f"no frame: {line.hex()}")
        if frame is not None:
            self.lines.append(line + b"\0")
        super()._sort(line, frame)

    def listen(self, until):
        frame = super().listen(until)
        self.raw = self.lines.popleft() if frame is not None else b""
        return frame


class Raw(squeal.Plant):
    """A plant and the line to it. Every wait has an end; nothing is asked twice."""

    def __init__(self, where, limit_s=30.0):
        """where: the path of a socket, tcp:PORT of this machine, or a terminal in /dev/."""
        name = where if where.startswith("/dev/") else where.replace("tcp:", "tcp:127.0.0.1:") if ":" in where else f"unix:{where}"
        with contextlib.ExitStack() as stack:
            port = self._open(name, time.monotonic() + limit_s)
            stack.callback(port.close)
            super().__init__(RawLink(port, limit_s, limit_s), stack.pop_all())
        self.limit_s = limit_s

    @staticmethod
    def _open(name, until):
        """Patient, because the other end may not listen yet."""
        while True:
            try:
                return squeal.open_port(name, squeal.BAUD, None, None)
            except squeal.NoAnswer:
                if time.monotonic() > until:
                    raise
                time.sleep(0.02)

    @property
    def raw(self):
        return self._link.raw

    def send(self, data):
        self._link.port.send(data, time.monotonic() + self.limit_s)

    def any_frame(self):
        """The next frame as (type, sequence, step, payload); its bytes on the line are in raw."""
        frame = self._link.listen(time.monotonic() + self.limit_s)
        if frame is None:
            raise Silence("no answer")
        return frame

    def frame(self):
        """The next frame that is a reply; samples and results of a study are put aside."""
        while self._link.keep(frame := self.any_frame()):
            pass
        return frame


class Controller(Raw):
    """Requests by their fields, replies by theirs: nothing is added, turned into words or held back."""

    @property
    def at(self):
        """Low word of the plant's step, as the last reply told."""
        return self._link.step

    @at.setter
    def at(self, step):
        self._link.step = step

    @property
    def step_sequence(self):
        """Of the last STEP."""
        return self._step_sequence - 1 & 0xffff

    @step_sequence.setter
    def step_sequence(self, sequence):
        self._step_sequence = sequence + 1 & 0xffff

    @property
    def samples(self):
        """(sequence, step, payload) of those that came."""
        return [frame[1:] for frame in self._link.samples]

    @property
    def results(self):
        """Of a study, those that came."""
        return [result(frame) for frame in self._link.results]

    def study_end(self):
        """All results of the study under way, its STUDY_END the last of them."""
        while not self.results or self.results[-1]["frame"] != "STUDY_END":
            self._link.keep(self.any_frame())
        told = self.results
        self._link.results.clear()
        return told

    def answer(self, name, sequence):
        """The fields of the reply to what was sent raw."""
        reply = self._link.reply(squeal.REQUESTS[name], sequence, time.monotonic() + self.limit_s)
        if reply is None:
            raise Silence("no answer")
        return reply[0] if len(reply) == 1 else reply

    def _refused(self, request, refusal):
        return Refused(refusal)

    def ask(self, name, *fields, sequence=None, step=None):
        if sequence is None:
            self._sequence = sequence = (self._sequence + 1) & 0xffff
        self.at = self.at if step is None else step
        try:
            reply = self._link.ask(squeal.REQUESTS[name], sequence, fields)
        except squeal.Refusal as refusal:
            raise Refused(refusal) from None
        if name == "READ":
            reply = (*reply[:2], struct.unpack("<f", reply[2])[0])
        return reply[0] if len(reply) == 1 else reply

    def refusal(self, name, *fields, **head):
        """The Refused that the request gets."""
        try:
            reply = self.ask(name, *fields, **head)
        except Refused as refused:
            return refused
        raise Silence(f"{name} was not refused but answered {reply}")

    def step(self, count=1, load_kind=KEEP, load=0.0, speed_kind=KEEP, speed=0.0):
        """Steps from where the plant stood at the last answer."""
        self._step_sequence = (self._step_sequence + 1) & 0xffff
        fields = self.ask("STEP", count, load_kind, speed_kind, load, speed, sequence=self.step_sequence, step=self.at)
        return dict(zip(STEP, fields))

    def status(self):
        return dict(zip(STATUS, self.ask("STATUS")))

    def set(self, may_reset=1, **values):
        """Parameters into force, all or none; choices by their numbers."""
        crc = self.ask("REVERT")
        for symbol, value in values.items():
            crc = self.ask("STAGE", SYMBOLS.index(symbol), value)[2]
        return self.ask("COMMIT", crc, may_reset)

    def preset(self, name):
        return self.ask("PRESET", PRESETS.index(name))
