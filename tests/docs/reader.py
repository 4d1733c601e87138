"""A reader who does what a page says: files, commands and Python, in one folder."""

import io
import shlex
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any

import kempe as kp
from docs.comparison import agrees
from docs.pages import Block
from kempe.cli import main


class Reader:
    """What one page does; its folder is the current one.

    Attributes:
        page: the page, for messages.
    """

    def __init__(self, page: Path) -> None:
        self.page = page
        self._names: dict[str, Any] = {"__name__": "__main__"}
        self._said = ""
        self._code = 0

    def follow(self, block: Block) -> None:
        """Do what a block says, and compare what it shows."""
        if block.language == "python":
            self._run(block)
        elif block.language == "text":
            assert not block.lead, f"{self._at(block)}: text must follow a block of Python"
            self._expect(block.text, self._said, self._at(block))
        elif block.language == "console":
            self._converse(block)
        elif block.language in ("toml", "json"):
            self._keep(block)

    def _at(self, block: Block) -> str:
        return f"{self.page.name}, line {block.line}"

    def _expect(self, shown: str, said: str, at: str) -> None:
        assert agrees(shown, said), f"{at}\n--- shown\n{shown}\n--- said\n{said}"

    def _run(self, block: Block) -> None:
        code = compile("\n" * (block.line - 1) + block.text, self.page, "exec")
        out = io.StringIO()
        with redirect_stdout(out):
            exec(code, self._names)
        self._said = out.getvalue()

    def _keep(self, block: Block) -> None:
        """Write a whole case to its file, or to any; it must load and assemble.

        But for one that is called faulty: a command that follows tells what is wrong with it.
        """
        whole = block.text.startswith(("kempe = 1", '{\n  "kempe": 1'))
        if block.file is None and not whole:
            return
        path = Path(block.file or f"unnamed.{block.language}")
        path.write_text(block.text, "utf-8")
        if whole and not path.name.startswith("faulty"):
            kp.load(path).start()

    def _converse(self, block: Block) -> None:
        """A transcript: `$ command`, and below what it says; without that, anything.

        A command must end well unless `$ echo $?` follows.
        """
        turns = [turn.partition("\n") for turn in f"\n{block.text}".split("\n$ ")[1:]]
        assert turns, f"{self._at(block)}: no command"
        for k, (command, _, shown) in enumerate(turns):
            at = f"{self._at(block)}: {command}"
            if command == "echo $?":
                self._expect(shown, f"{self._code}\n", at)
                continue
            said = self._command(command, at)
            if shown.strip():
                self._expect(shown, said, at)
            told = k + 1 < len(turns) and turns[k + 1][0] == "echo $?"
            assert told or self._code == 0, f"{at}\nexit code {self._code}\n{said}"

    def _command(self, command: str, at: str) -> str:
        program, *words = shlex.split(command, comments=True)
        assert program in ("./kempe", "kempe"), f"{at}: only kempe is run here"
        out = io.StringIO()
        with redirect_stdout(out), redirect_stderr(out):
            self._code = main(words)
        return out.getvalue()
