"""A reader that executes a page: it writes files and runs commands and Python in one folder."""

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
    """Execution of one page in the current folder.

    Attributes:
        page: the page, for messages.
    """

    def __init__(self, page: Path) -> None:
        self.page = page
        self._names: dict[str, Any] = {"__name__": "__main__"}
        self._output = ""
        self._code = 0

    def follow(self, block: Block) -> None:
        """Execute a block and compare its output with the output shown."""
        if block.language == "python":
            self._run(block)
        elif block.language == "text":
            assert not block.lead, f"{self._at(block)}: text must follow a block of Python"
            self._expect(block.text, self._output, self._at(block))
        elif block.language == "console":
            self._converse(block)
        elif block.language in ("toml", "json"):
            self._keep(block)

    def _at(self, block: Block) -> str:
        return f"{self.page.name}, line {block.line}"

    def _expect(self, shown: str, output: str, at: str) -> None:
        assert agrees(shown, output), f"{at}\n--- shown\n{shown}\n--- output\n{output}"

    def _run(self, block: Block) -> None:
        code = compile("\n" * (block.line - 1) + block.text, self.page, "exec")
        out = io.StringIO()
        with redirect_stdout(out):
            exec(code, self._names)
        self._output = out.getvalue()

    def _keep(self, block: Block) -> None:
        """Write a complete case to its file, or to any file, and assemble it.

        A case with the name `faulty` is not assembled; a later command shows its errors.
        """
        whole = block.text.startswith(("kempe = 1", '{\n  "kempe": 1'))
        if block.file is None and not whole:
            return
        path = Path(block.file or f"unnamed.{block.language}")
        path.write_text(block.text, "utf-8")
        if whole and not path.name.startswith("faulty"):
            kp.load(path).start()

    def _converse(self, block: Block) -> None:
        """Run a transcript: `$ command`, followed by its output or by nothing.

        A command must succeed unless `$ echo $?` follows.
        """
        turns = [turn.partition("\n") for turn in f"\n{block.text}".split("\n$ ")[1:]]
        assert turns, f"{self._at(block)}: no command"
        for k, (command, _, shown) in enumerate(turns):
            at = f"{self._at(block)}: {command}"
            if command == "echo $?":
                self._expect(shown, f"{self._code}\n", at)
                continue
            output = self._command(command, at)
            if shown.strip():
                self._expect(shown, output, at)
            checked = k + 1 < len(turns) and turns[k + 1][0] == "echo $?"
            assert checked or self._code == 0, f"{at}\nexit code {self._code}\n{output}"

    def _command(self, command: str, at: str) -> str:
        program, *words = shlex.split(command, comments=True)
        assert program in ("./kempe", "kempe"), f"{at}: only kempe is run here"
        out = io.StringIO()
        with redirect_stdout(out), redirect_stderr(out):
            self._code = main(words)
        return out.getvalue()
