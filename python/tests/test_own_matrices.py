"""The Python of docs/own-matrices.md is run: with pyNastran and pyuff on files where they are
installed, else on the arrays that they return."""

import importlib
import importlib.util
import re
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

import signorini as sg

PAGE = Path(__file__).parents[2] / "docs/own-matrices.md"
GRIDS = [11, 12, 13]
STIFFNESS = np.array([[2e3, -1e3, 0.0], [-1e3, 2e3, -1e3], [0.0, -1e3, 1e3]])
SQUARED, SHAPES = np.linalg.eigh(STIFFNESS)  # of three masses of 1 kg
FREQUENCIES = np.sqrt(SQUARED) / (2.0 * np.pi)
TIME = np.linspace(0.0, 5.0, 5001)
FORCE = 20.0 * np.sin(2.0 * np.pi * 3.0 * TIME)


def modes_of_op2() -> SimpleNamespace:
    """What `read_op2` returns for a file of SOL 103."""
    data = np.zeros((3, 3, 6), np.float32)
    data[:, :, 1] = SHAPES.T
    vectors = SimpleNamespace(data=data, node_gridtype=np.array([[grid, 1] for grid in GRIDS]))
    table = SimpleNamespace(cycles=FREQUENCIES.astype("f4"), generalized_mass=np.ones(3, "f4"))
    return SimpleNamespace(eigenvectors={1: vectors}, eigenvalues={"THREE MASSES": table})


def write_nastran(folder: Path) -> None:
    """The grid points, and stiffness and mass as DMIG entries of 16 columns."""
    places = "".join(f"GRID,{grid},,{float(n)},0.0,0.0\n" for n, grid in enumerate(GRIDS))
    (folder / "three-masses.bdf").write_text(places)
    punched = places
    for name, matrix in {"KAAX": STIFFNESS, "MAAX": np.eye(3)}.items():
        punched += f"DMIG    {name:8}{0:8}{6:8}{2:8}{0:8}\n"
        for j, column in enumerate(GRIDS):
            punched += f"DMIG*   {name:16}{column:16}{2:16}\n"
            for i in range(j, 3):
                if matrix[i, j]:
                    number = f"{matrix[i, j]:16.8E}".replace("E", "D")
                    punched += f"*       {GRIDS[i]:16}{2:16}{number}\n"
    (folder / "three-masses.pch").write_text(punched)


def read_bdf(name: str, **_: Any) -> SimpleNamespace:
    """What pyNastran's function of that name returns for these files."""
    position = {grid: np.array([float(n), 0.0, 0.0]) for n, grid in enumerate(GRIDS)}
    places = {grid: SimpleNamespace(get_position=lambda at=at: at) for grid, at in position.items()}
    rows = {n: (grid, 2) for n, grid in enumerate(GRIDS)}
    read = {"KAAX": (STIFFNESS, rows, rows), "MAAX": (np.eye(3), rows, rows)}
    entries = {key: SimpleNamespace(get_matrix=lambda of=of: of) for key, of in read.items()}
    return SimpleNamespace(nodes=places, dmig=entries if name.endswith(".pch") else {})


def sets_of_uff() -> list[dict[str, Any]]:
    """What `UFF.read_sets` returns: nodes, three modes and a record."""
    zero = np.zeros(3)
    nodes = {"type": 15, "node_nums": [float(grid) for grid in GRIDS], "x": [0.0, 1.0, 2.0]}
    modes = [
        {
            "type": 55, "analysis_type": 2, "freq": frequency, "modal_m": 1.0,
            "modal_damp_vis": 0.01, "node_nums": np.array(GRIDS), "r1": zero, "r2": shape, "r3": zero,
        }
        for frequency, shape in zip(FREQUENCIES, SHAPES.T)
    ]  # fmt: skip
    return [nodes, *modes, {"type": 58, "func_type": 1, "x": TIME, "data": FORCE}]


def write_uff(folder: Path) -> None:
    """The same sets as a file, by pyuff itself."""
    pyuff: Any = importlib.import_module("pyuff")
    none = {f"id{n}": "NONE" for n in range(1, 6)}
    zero = [0.0, 0.0, 0.0]
    sets = [
        pyuff.prepare_15(
            node_nums=GRIDS, def_cs=[0] * 3, disp_cs=[0] * 3, color=[1] * 3, x=[0.0, 1.0, 2.0], y=zero, z=zero
        )
    ]  # fmt: skip
    for number, (frequency, shape) in enumerate(zip(FREQUENCIES, SHAPES.T), 1):
        sets.append(
            pyuff.prepare_55(
                **none, model_type=1, analysis_type=2, data_ch=2, spec_data_type=8, data_type=2,
                n_data_per_node=3, load_case=1, mode_n=number, freq=float(frequency), modal_m=1.0,
                modal_damp_vis=0.01, modal_damp_his=0.0, node_nums=GRIDS,
                r1=np.zeros(3), r2=shape, r3=np.zeros(3),
            )
        )  # fmt: skip
    sets.append(
        pyuff.prepare_58(
            **none, binary=0, func_type=1, ver_num=0, load_case_id=0, rsp_ent_name="NONE", rsp_node=11,
            rsp_dir=2, ref_ent_name="NONE", ref_node=11, ref_dir=2, z_axis_value=0.0,
            **{f"{axis}_{part}": 0 for axis in ("abscissa", "ordinate", "orddenom", "z_axis")
               for part in ("spec_data_type", "len_unit_exp", "force_unit_exp", "temp_unit_exp")},
            **{f"{axis}_axis_units_lab": "NONE" for axis in ("abscissa", "ordinate", "orddenom", "z_axis")},
            ord_data_type=4, num_pts=len(TIME), abscissa_spacing=1, abscissa_min=0.0,
            abscissa_inc=float(TIME[1]), data=FORCE, x=TIME,
        )
    )  # fmt: skip
    pyuff.UFF(str(folder / "three-masses.uff")).write_sets(sets, "overwrite")


def module(name: str, **content: Any) -> ModuleType:
    made = ModuleType(name)
    made.__dict__.update(content)
    return made


def lend_readers(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Files for the readers that are installed, and modules in the place of the others."""
    write_nastran(folder)
    if importlib.util.find_spec("pyNastran") is None:
        for name in ["pyNastran", "pyNastran.bdf", "pyNastran.op2"]:
            monkeypatch.setitem(sys.modules, name, module(name))
        bdf = module("pyNastran.bdf.bdf", read_bdf=read_bdf)
        monkeypatch.setitem(sys.modules, "pyNastran.bdf.bdf", bdf)
    # pyNastran writes no modes: these are arrays in any case.
    op2 = module("pyNastran.op2.op2", read_op2=lambda _, debug: modes_of_op2())
    monkeypatch.setitem(sys.modules, "pyNastran.op2.op2", op2)
    if importlib.util.find_spec("pyuff") is None:
        file = SimpleNamespace(read_sets=sets_of_uff)
        monkeypatch.setitem(sys.modules, "pyuff", module("pyuff", UFF=lambda _: file))
    else:
        write_uff(folder)


def test_nastran_and_universal_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    lend_readers(tmp_path, monkeypatch)
    blocks = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.M | re.S)
    assert len(blocks) == 4
    names: dict[str, Any] = {}
    for number, block in enumerate(blocks, 1):
        exec(compile(block, f"{PAGE.name}, block {number}", "exec"), names)
    # The same three masses by their matrices: damping in the modes, and the first impacts.
    scene = sg.matrices(
        np.eye(3), 0.01, STIFFNESS, walls=sg.support("stop", 2e-3, at=2, restitution=0.7),
        loads=[sg.Load.harmonic(20.0, 3.0, at=0)], duration=5.0,
    )  # fmt: skip
    first = scene.run(step=1e-4).contacts["start"][:3]
    for name in ["from_op2", "from_punch", "from_uff"]:
        found = names[name].run(step=1e-4).contacts["start"][:3]
        assert np.allclose(found, first, rtol=2e-3), f"{name}: {found}, {first}"
    rows = (tmp_path / "nastran-shapes.csv").read_text().splitlines()
    assert [row.split(",")[0] for row in rows] == ["root", "tip"]
    assert np.allclose([float(x) for x in rows[1].split(",")[1:]], SHAPES[2], atol=1e-6)
