"""The Python of the documents is run, as a reader would."""

import re
from pathlib import Path

import matplotlib.pyplot as plt
import pytest

ROOT = Path(__file__).parents[2]
PAGES = {
    "docs/python.md": 18,
    "docs/fit.md": 4,
    "docs/own-tube.md": 1,
    "docs/own-paper-figure.md": 1,
    "README.md": 1,
    "python/README.md": 1,
}


@pytest.mark.parametrize("page", PAGES)
def test_blocks_run_from_top_to_bottom(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    text = (ROOT / page).read_text(encoding="utf-8")
    for name, content in re.findall(r"^```\w+ (\S+)\n(.*?)^```", text, re.M | re.S):
        (tmp_path / name).write_text(content, encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
    assert len(blocks) == PAGES[page]
    names: dict[str, object] = {}
    for number, block in enumerate(blocks, 1):
        exec(compile(block, f"{page}, block {number}", "exec"), names)
    plt.close("all")
    shown = re.findall(r"savefig\(\"(.*?)\"\)", "".join(blocks))
    assert all((tmp_path / name).stat().st_size > 10_000 for name in shown)
    assert len(shown) == {"docs/python.md": 7, "docs/own-paper-figure.md": 1, "README.md": 1}.get(page, 0)
