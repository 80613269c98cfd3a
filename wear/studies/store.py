"""Results of a study on disk: a Zarr group that xarray opens; no chunk is written in part.

Each array is cut into the chunks of the design, a file each. Every file is written under another
name first and the status of a chunk last, so that a chunk without a status is missing.
"""

from __future__ import annotations

import json
import math
import shutil
import tempfile
import warnings
from collections.abc import Iterator
from dataclasses import asdict
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wear.faults import UsageError
from wear.quantities import unit_of
from wear.studies.design import Chunk
from wear.studies.notices import notices_of_rows
from wear.studies.rows import Answers, RowStatus, Study
from wear.studies.vary import Levels

if TYPE_CHECKING:
    import xarray


FILE_OVERHEAD = 8192  # bytes on disk: its folder, and the rest of its last block


class Variable(NamedTuple):
    """One array of a study: name, type, whether it has a dimension of cycles, unit and meaning."""

    name: str
    kind: str
    per_cycle: bool
    unit: str
    meaning: str


VARIABLES = (
    Variable("bearing_wear_mm", "float64", True, "mm", "wear of the bearing"),
    Variable("error_estimate", "float64", True, "1", "estimated relative error of the wear"),
    Variable("cycles_to_wear", "float64", False, "1", "number of cycles to the wear depth"),
    Variable(
        "cycles_to_wear_error", "float64", False, "1", "estimated relative error of that number"
    ),
    Variable("reason", "string", False, "", "why the row has no answer"),
    Variable("status", "uint8", False, "", "outcome of the row"),
)


class Store:
    """The results of one study at a path.

    Raises
    ------
    UsageError
        if another study, or something else, is there already, the disk is too small, or zarr and
        xarray are not installed.
    """

    def __init__(self, path: Path, study: Study) -> None:
        if not (find_spec("zarr") and find_spec("xarray")):
            raise UsageError("a study needs zarr and xarray: pip install 'derive-wear[study]'")
        self.path, self.study, self.design = path, study, study.design
        self._identity = identity(study)
        if path.exists():
            self._group: Any = self._opened()
        else:
            self._require_space()
            self._group = self._created()

    @property
    def _variables(self) -> tuple[Variable, ...]:
        with_life = self.study.until_wear is not None
        return tuple(v for v in VARIABLES if with_life or not v.name.startswith("cycles_to_wear"))

    def missing(self) -> Iterator[Chunk]:
        """Yield every chunk that has not been written."""
        status = self._group["status"]
        for chunk in self.design.chunks():
            if np.any(np.asarray(status[chunk]) == RowStatus.PENDING):
                yield chunk

    def write(self, chunk: Chunk, answers: Answers) -> None:
        """Write the answers of a chunk, the status last."""
        shape = tuple(part.stop - part.start for part in chunk)
        if self.design.kind != "grid":
            for key, values in self.design.columns(chunk).items():
                self._group[key][chunk] = values
        for variable in self._variables:
            values = np.asarray(getattr(answers, variable.name))
            whole = (*chunk, slice(None)) if variable.per_cycle else chunk
            self._group[variable.name][whole] = values.reshape(*shape, *values.shape[1:])

    def counts(self) -> dict[str, int]:
        """Return how many rows have each status, by its name."""
        rows = np.zeros(max(RowStatus) + 1, dtype=np.int64)
        for chunk in self.design.chunks():
            rows += np.bincount(np.ravel(self._group["status"][chunk]), minlength=len(rows))
        return {status.name.lower(): int(rows[status]) for status in RowStatus}

    def write_notices(self) -> None:
        """Write the attribute `notices` of the results: implausible magnitudes in the rows."""
        wear, cycles = self._group["bearing_wear_mm"], len(self.study.cycles)
        chunks = (
            (self.design.columns(chunk), np.asarray(wear[*chunk, :]).reshape(-1, cycles))
            for chunk in self.design.chunks()
        )
        self._group.attrs["notices"] = notices_of_rows(self.study, chunks)

    def dataset(self) -> xarray.Dataset:
        """Return the results as a labelled dataset, read from disk as they are used."""
        import xarray

        results: xarray.Dataset = xarray.open_zarr(self.path, chunks=None)
        return results

    def _opened(self) -> Any:
        import zarr

        try:
            group = zarr.open_group(self.path, mode="r+")
            recorded = json.loads(str(group.attrs["study"]))
        except (KeyError, ValueError, OSError) as fault:
            raise UsageError(f"{self.path}: exists and is not a study") from fault
        if recorded != self._identity:
            differ = ", ".join(
                key for key in self._identity if recorded.get(key) != self._identity[key]
            )
            raise UsageError(
                f"{self.path}: belongs to another study, which differs in: {differ}; "
                "give another name, or remove it"
            )
        return group

    def _created(self) -> Any:
        """Make the arrays under another name, then move them to their place."""
        import zarr

        folder = Path(tempfile.mkdtemp(prefix=f".{self.path.name}.", dir=self.path.parent))
        try:
            group: Any = zarr.open_group(folder, mode="w", zarr_format=3)
            lengths = dict(zip(self.design.dimensions, self.design.shape, strict=True))
            chunks = dict(zip(self.design.dimensions, self.design.chunk_shape, strict=True))
            lengths["cycle"] = chunks["cycle"] = len(self.study.cycles)
            fills = {"uint8": int(RowStatus.PENDING), "string": "", "int64": 0, "float64": math.nan}
            for name, dimensions, kind, attributes in self._arrays():
                # A coordinate is known beforehand, and written whole.
                parts = lengths if dimensions == (name,) else chunks
                group.create_array(
                    name,
                    shape=tuple(lengths[dimension] for dimension in dimensions),
                    chunks=tuple(parts[dimension] for dimension in dimensions),
                    dtype=kind,
                    fill_value=fills[kind],
                    dimension_names=dimensions,
                    attributes={key: value for key, value in attributes.items() if value},
                )
            group["cycle"][:] = np.array(self.study.cycles)
            if self.design.kind == "grid":
                for vary in self.design.vary:
                    assert isinstance(vary, Levels)
                    group[vary.key][:] = np.array(vary.values)
            group.attrs["study"] = json.dumps(self._identity)
            group.attrs["scene"] = self.study.scene.to_toml()
            with warnings.catch_warnings():  # Zarr's format 3 does not specify this
                warnings.simplefilter("ignore")
                zarr.consolidate_metadata(folder)
            folder.chmod(0o755)
            try:
                folder.rename(self.path)
            except OSError as taken:
                if not self.path.exists():
                    raise
                remedy = "to go on with it, give the same command again once the other has ended"
                raise UsageError(
                    f"{self.path}: another process has just made it; {remedy}"
                ) from taken
        except BaseException:
            shutil.rmtree(folder, ignore_errors=True)
            raise
        return zarr.open_group(self.path, mode="r+")

    def _arrays(self) -> Iterator[tuple[str, tuple[str, ...], str, dict[str, Any]]]:
        """Yield name, dimensions, type and attributes of every array."""
        rows = self.design.dimensions
        yield "cycle", ("cycle",), "int64", {"units": "1", "long_name": "number of cycles"}
        for vary in self.design.vary:
            dimensions = (vary.key,) if self.design.kind == "grid" else rows
            yield vary.key, dimensions, "float64", {"units": unit_of(vary.key) or "1"}
        for variable in self._variables:
            attributes: dict[str, Any] = {"units": variable.unit, "long_name": variable.meaning}
            if variable.name == "status":
                named = [status for status in RowStatus if status is not RowStatus.PENDING]
                attributes["flag_values"] = [int(status) for status in named]
                attributes["flag_meanings"] = " ".join(status.name.lower() for status in named)
            if self.design.kind != "grid":
                attributes["coordinates"] = " ".join(vary.key for vary in self.design.vary)
            dimensions = (*rows, "cycle") if variable.per_cycle else rows
            yield variable.name, dimensions, variable.kind, attributes

    def _require_space(self) -> None:
        parent = self.path.parent
        if not parent.is_dir():
            raise UsageError(f"{self.path}: there is no folder {parent}; make it first")
        needed, free = disk_bytes(self.study), shutil.disk_usage(parent).free
        if needed > free:
            raise UsageError(
                f"{self.path}: the study needs up to {needed / 1e9:.3g} GB, "
                f"{free / 1e9:.3g} GB are free"
            )


def disk_bytes(study: Study) -> int:
    """Return the largest size of all results in bytes: uncompressed, a file a chunk and array."""
    design, until = study.design, study.until_wear is not None
    keys = len(design.vary) if design.kind != "grid" else 0
    numbers = 2 * len(study.cycles) + until + keys
    files = (3 + until + keys) * sum(1 for _ in design.chunks())
    files += 2 * (5 + until + len(design.vary))  # coordinates, and the metadata of each array
    return design.rows * (8 * numbers + 1) + files * FILE_OVERHEAD


def identity(study: Study) -> dict[str, Any]:
    """Return the data that define a study: studies that share them agree in every bit."""
    fields = {
        "scene": study.scene.to_tables(),
        "vary": [asdict(vary) for vary in study.design.vary],
        "design": study.design.kind,
        "samples": int(study.design.samples),
        "seed": int(study.design.seed),
        "cycles": list(study.cycles),
        "until_wear_mm": study.until_wear,
        "rtol": study.rtol,
        "version": version("derive-wear"),
    }
    return dict(json.loads(json.dumps(fields)))
