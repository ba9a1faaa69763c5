"""Where bough.py is: in the add-on's own folder (tools/blender/pack puts it there, with its libraries), or where this Blender's Python looks."""
import importlib
import importlib.util
import pathlib


class Missing(Exception):
    """bough.py, or its library, is not there; the message says what to do."""


def bough():
    own = pathlib.Path(__file__).parent / "bough.py"
    try:
        if own.is_file():
            return importlib.import_module("." + own.stem, __package__)
        return importlib.import_module("bough")
    except (ImportError, OSError) as error:
        raise Missing(f"{error}; install bough, or this add-on from the archive that tools/blender/pack makes") from error
