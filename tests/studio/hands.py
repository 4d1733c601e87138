"""Mouse and keys of a person who draws from nothing; each click, drag and key counts."""

from dataclasses import dataclass
from pathlib import Path

from command_line import kempe
from studio.window import Studio

#: A place of the sheet, m.
Place = tuple[float, float]


@dataclass
class Hands:
    """What a person does in a window, counted."""

    one: Studio
    clicks: int = 0
    drags: int = 0
    keys: int = 0

    def new(self) -> None:
        """An empty sheet."""
        self.press("#new")
        assert self.one.toml().count("[bodies") <= 1

    def press(self, selector: str) -> None:
        """Click a control."""
        self.one.page.locator(selector).first.click()
        self.clicks += 1
        self.one.settle()

    def key(self, name: str) -> None:
        """Press one key."""
        self.one.page.keyboard.press(name)
        self.keys += 1
        self.one.settle()

    def at(self, *places: Place) -> None:
        """Click places of the sheet."""
        for place in places:
            self.one.click(*place)
            self.clicks += 1

    def drag(self, begin: Place, end: Place) -> None:
        """Drag from one place to another."""
        mouse = self.one.page.mouse
        mouse.move(*self.one.screen(*begin))
        mouse.down()
        mouse.move(*self.one.screen(*end), steps=5)
        mouse.up()
        self.drags += 1
        self.one.settle()

    def use(self, tool: str, *places: Place) -> None:
        """Choose a tool and click with it; what it has added has no fault."""
        self.press(f".left [data-type={tool}]")
        self.at(*places)
        assert "Problem" not in self.one.message(), self.one.message()

    def bars(self, *ends: Place) -> None:
        """Bars from each of the places to the next one of its pair."""
        self.use("bar", *ends)

    def plate(self, *corners: Place) -> None:
        """A body with several points."""
        self.use("body", *corners)
        self.key("Enter")

    def select(self, place: Place) -> None:
        """Select what is at a place."""
        self.key("Escape")
        self.at(place)

    def fill(self, label: str, words: str) -> None:
        """Type into a field of the panel."""
        field = self.one.page.get_by_label(label, exact=True).first
        field.click()
        field.fill(words)
        field.press("Enter")
        self.clicks += 1
        self.keys += len(words) + 1
        self.one.settle()
        faults = self.one.page.locator(".field .problem")
        assert not faults.count(), faults.all_inner_texts()

    def choose(self, label: str, words: str) -> None:
        """Choose an entry of a list of the panel: a click on the list and one on the entry."""
        self.one.page.get_by_label(label, exact=True).first.select_option(words)
        self.clicks += 2
        self.one.settle()

    def read(self, says: str = "states up to") -> None:
        """Run the analysis that the page chooses."""
        self.press("#mode-read")
        self.one.wait("!document.querySelector('#run')?.disabled", 30.0)
        assert says in self.one.message(), self.one.message()

    def saved(self, folder: Path) -> Path:
        """The file that *Save* writes."""
        with self.one.page.expect_download() as download:
            self.press("#save")
        path = folder / "drawn.toml"
        download.value.save_as(path)
        return path

    def counts(self) -> str:
        """The counts as a row of docs/studio.md."""
        return f"{self.clicks} | {self.drags} | {self.keys}"


def run(path: Path) -> Path:
    """`kempe run` of a file without edits; the folder of its results."""
    folder = path.parent / "results"
    done = kempe("run", path, "-o", folder, "-q", "--figures", "none")
    assert done.returncode == 0, done.stderr
    return folder
