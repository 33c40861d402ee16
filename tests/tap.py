"""TAP from a script in Python: claims are numbered as they are made, the plan stands at the end."""
import subprocess


class Tap:
    def __init__(self):
        self.count, self.failed = 0, 0

    def note(self, text):
        if isinstance(text, subprocess.CompletedProcess):
            text = f"exit {text.returncode}\n{text.stdout or ''}{text.stderr or ''}"
        for line in str(text).splitlines():
            print(f"# {line}", flush=True)

    def check(self, holds, claim, *notes):
        """The notes, texts or runs, are told of a claim that does not hold."""
        self.count += 1
        self.failed += not holds
        print(f"{'' if holds else 'not '}ok {self.count} - {claim}", flush=True)
        if not holds:
            for note in notes:
                self.note(note)

    def finish(self):
        print(f"1..{self.count}")
        raise SystemExit(self.failed != 0)
