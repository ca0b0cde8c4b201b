"""Describes a folder of evolution runs for an archive of research data, such as Zenodo.

    python ro_crate.py out MIT

writes out/ro-crate-metadata.json, an RO-Crate 1.1 (https://w3id.org/ro/crate/1.1) of the profile for runs of a program,
Process Run Crate 0.5: for each seed its evolution, generations and the version of nbc, and the size and SHA-256 of each
file. `rocrate-validator validate -p process-run-crate out` checks it. Without arguments it describes a small run.
"""

from __future__ import annotations

import hashlib
import json
import sys
from datetime import datetime, timezone
from pathlib import Path
from typing import Any, Dict, List

import nbc

CRATE = "https://w3id.org/ro/crate/1.1"
PROCESS = "https://w3id.org/ro/wfrun/process/0.5"
FILES = {
    "checkpoint.nbc": ("The archive, with all that is needed to go on", "application/octet-stream"),
    "progress.jsonl": ("A line for each generation", "application/jsonl"),
}

Entity = Dict[str, Any]


def reference(entity: Entity) -> Entity:
    return {"@id": entity["@id"]}


def file_entity(root: Path, path: Path, title: str) -> Entity:
    description, media = FILES[path.name]
    content = path.read_bytes()
    return {
        "@id": path.relative_to(root).as_posix(),
        "@type": "File",
        "name": f"{description} of {title}",
        "description": description,
        "encodingFormat": media,
        "contentSize": str(len(content)),
        "sha256": hashlib.sha256(content).hexdigest(),
    }


def run_entities(root: Path, checkpoint: Path) -> List[Entity]:
    """A run, its settings, its folder, its files and the program; the run is the first."""
    record = json.loads(checkpoint.read_text().split("\n")[1])  # the first line is a header
    settings = {
        "evolution": record["evolution"]["name"],
        "seed": record["state"]["seed"],
        "generations": record["state"]["generation"],
    }
    title = "{evolution}, seed {seed}, {generations} generations".format(**settings)
    folder = checkpoint.parent.relative_to(root).as_posix()
    values = [
        {"@id": f"#run/{folder}/{name}", "@type": "PropertyValue", "name": name, "value": value}
        for name, value in settings.items()
    ]
    paths = [checkpoint.with_name(name) for name in FILES if checkpoint.with_name(name).exists()]
    files = [file_entity(root, path, title) for path in paths]
    program = {
        "@id": f"#nbc-{record['version']}",
        "@type": "SoftwareApplication",
        "name": "nbc",
        "description": "Circuits made of soft robots",
        "softwareVersion": record["version"],
    }
    ended = datetime.fromtimestamp(checkpoint.stat().st_mtime, timezone.utc)
    action = {
        "@id": f"#run/{folder}",
        "@type": "CreateAction",
        "name": title,
        "description": "An evolution of bodies by `nbc evolve`; a seed gives the same archive on every machine",
        "instrument": reference(program),
        "object": [reference(value) for value in values],
        "result": [reference(file) for file in files],
        "endTime": ended.isoformat(timespec="seconds"),
    }
    entities = [action, *values, *files, program]
    if folder != ".":  # the files of a run in the crate's own folder are parts of the crate
        parts = [reference(file) for file in files]
        entities.append({"@id": f"{folder}/", "@type": "Dataset", "name": title, "hasPart": parts})
    return entities


def ro_crate(root: Path, license: str) -> Entity:
    """The metadata of the runs below a folder."""
    runs = [run_entities(root, checkpoint) for checkpoint in sorted(root.glob("**/checkpoint.nbc"))]
    if not runs:
        raise SystemExit(f"no runs below {root}")
    kinds = [("Dataset" if any(entity["@type"] == "Dataset" for entity in run) else "File", run) for run in runs]
    parts = [reference(entity) for kind, run in kinds for entity in run if entity["@type"] == kind]
    terms = {"@id": f"https://spdx.org/licenses/{license}", "@type": "CreativeWork", "name": license}
    crate = {
        "@id": "./",
        "@type": "Dataset",
        "conformsTo": {"@id": PROCESS},
        "name": root.resolve().name,
        "description": f"Evolution runs of soft robots as logic gates: {len(runs)} seeds, with their archives",
        "datePublished": max(run[0]["endTime"] for run in runs).split("T")[0],
        "license": reference(terms),
        "hasPart": parts,
        "mentions": [reference(run[0]) for run in runs],
    }
    metadata = {
        "@id": "ro-crate-metadata.json",
        "@type": "CreativeWork",
        "conformsTo": {"@id": CRATE},
        "about": {"@id": "./"},
    }
    process = {"@id": PROCESS, "@type": "CreativeWork", "name": "Process Run Crate", "version": "0.5"}
    entities = [metadata, crate, process, terms, *(entity for run in runs for entity in run)]
    graph = list({entity["@id"]: entity for entity in entities}.values())
    return {"@context": f"{CRATE}/context", "@graph": graph}


def main() -> None:
    if len(sys.argv) == 3:
        root, license = Path(sys.argv[1]), sys.argv[2]
    else:
        root, license = Path("out"), "MIT"
        folder = root / "small" / "seed-1"
        folder.mkdir(parents=True, exist_ok=True)
        evolution = nbc.Evolution(shape=(2, 3), batch=4, generations=2)
        nbc.evolve(evolution, checkpoint=folder / "checkpoint.nbc")
    path = root / "ro-crate-metadata.json"
    path.write_text(json.dumps(ro_crate(root, license), indent=2) + "\n")
    print(path)


if __name__ == "__main__":
    main()
