"""bough: trees that move as wood moves.

    import bough
    tree = bough.convert(bough.grow("apple", bodies=2000, seed=7))
    scene = bough.Scene(wind="gusty")
    scene.add(tree)
    run = bough.Simulation(scene, step=1 / 30, precision="float")
    for frame in range(90):
        run.step()
        use(run.positions, run.rotations)

SI units; world axes, y up; quaternions x, y, z, w, world from body. A body's origin is its own joint, its z axis runs along it. Bodies stand in
document order, the trees' one after another, then balls, then walkers.

Arrays are numpy's, without a copy and not to be written to: they show memory of the object that they were asked of, which lives as long as they do. Those
of a simulation change when they are asked for again after a step (`run.positions.copy()` keeps a moment).

Errors are exceptions with the message that bough's tools print: UsageError (a ValueError: the call is wrong, a value of a wrong type too), InputError (a
document is broken, a scene cannot be run), NonFiniteError, OutputError; all are Error, with the tools' exit code in `code`. Python's own are a TypeError
for arguments that a function has not, and an AttributeError for names that an object has not.

Any thread may call; one simulation or scene is used by one thread at a time. Python's lock is not held in a call.

The library, libbough_files.so, is looked for beside this file's installation, then where the system has its libraries; the environment's
BOUGH_LIBRARY names another. libbough_imports.so, which reads other programs' trees, is taken from the same place when a file is first read.
"""
import collections
import ctypes
import ctypes.util
import functools
import os
import pathlib
import re
import secrets
import stat
import weakref

import numpy as np

__all__ = ["Error", "UsageError", "InputError", "NonFiniteError", "OutputError", "Splines", "Tree", "Scene", "Simulation", "Wind", "Report", "Events",
           "Balls", "StepError", "Hit", "species", "grow", "convert", "read_splines", "read_tree", "read_scene", "wind_preset", "__version__"]

_ABI = 3


class Error(Exception):
    """What bough refused; `code` is the tools' exit code."""
    code = 0


class UsageError(Error, ValueError):
    """The call is wrong: a number out of range, a body that is not there, an unknown name."""
    code = 1


class InputError(Error):
    """A document is broken, or a scene cannot be run."""
    code = 2


class NonFiniteError(Error):
    """The simulation became non-finite; the message names stage and body."""
    code = 3


class OutputError(Error):
    """What was to be written cannot be."""
    code = 4


# --- The C interface, bough_c.h -----------------------------------------------------------------------------------------------------------------

_double3 = ctypes.c_double * 3
_size = ctypes.c_size_t


class _Growth(ctypes.Structure):
    _fields_ = [("check", ctypes.c_uint64), ("species", ctypes.c_char_p), ("bodies", ctypes.c_int64), ("seed", ctypes.c_uint64),
                ("age", ctypes.c_double), ("leaves", ctypes.c_int32), ("petals", ctypes.c_int32), ("fruit", ctypes.c_int32)]


class _Conversion(ctypes.Structure):
    _fields_ = [("check", ctypes.c_uint64), ("material", ctypes.c_char_p), ("segment_length", ctypes.c_double), ("max_bend", ctypes.c_double),
                ("max_bodies", ctypes.c_int64)]


class _Bodies(ctypes.Structure):
    _fields_ = [("count", _size)] + [(name, ctypes.c_void_p) for name in ("parent", "kind", "size", "mass", "com", "stiffness", "damping", "branch",
                                                                          "level")] + [("trees", _size), ("first_body", ctypes.c_void_p)]


class Wind(ctypes.Structure):
    """A wind's fields that may change in a run: velocity (3) [m/s] at the reference height, reference_height [m], profile [1], turbulence [1],
    gust_factor [1], gust_period [s], seed. From wind_preset()."""
    _fields_ = [("_check", ctypes.c_uint64), ("_velocity", _double3), ("reference_height", ctypes.c_double), ("profile", ctypes.c_double),
                ("turbulence", ctypes.c_double), ("gust_factor", ctypes.c_double), ("gust_period", ctypes.c_double), ("seed", ctypes.c_uint64)]

    def __setattr__(self, name, value):
        if name not in _WIND_FIELDS and name != "_velocity":
            raise AttributeError(f"Wind: has no {name}, expected {', '.join(_WIND_FIELDS)}")
        if name == "seed":
            value = _whole(value, name, 0, 2**64 - 1)
        elif name not in ("velocity", "_velocity"):
            value = _number(value, name)
        super().__setattr__(name, value)

    @property
    def velocity(self):
        """(3) [m/s], blowing toward; an array of its own that is not written to: `wind.velocity = [20, 0, 0]` changes it."""
        value = np.array(self._velocity)
        value.flags.writeable = False
        return value

    @velocity.setter
    def velocity(self, value):
        self._velocity = _vector(value, "velocity")

    def __repr__(self):
        return "Wind(" + ", ".join(f"{name}={value}" for name, value in [("velocity", list(self._velocity))] + [
            (name, getattr(self, name)) for name, _ in self._fields_[2:]]) + ")"


_WIND_FIELDS = ("velocity",) + tuple(name for name, _ in Wind._fields_[2:])


class _Settings(ctypes.Structure):
    _fields_ = [("check", ctypes.c_uint64), ("step", ctypes.c_double), ("precision", ctypes.c_int32), ("method", ctypes.c_int32),
                ("sleep", ctypes.c_double), ("threads", ctypes.c_int32), ("velocities", ctypes.c_int32), ("torques", ctypes.c_int32),
                ("stresses", ctypes.c_int32), ("pulls", ctypes.c_int32), ("grounds", ctypes.c_int32), ("portable", ctypes.c_int32)]


class _Report(ctypes.Structure):
    _fields_ = [("steps", ctypes.c_int64), ("time", ctypes.c_double)] + [
        (name, ctypes.c_uint64) for name in ("fast_turns", "guarded", "limited", "broke", "hits", "landed")]


class _Ground(ctypes.Structure):
    _fields_ = [("check", ctypes.c_uint64), ("position", _double3), ("rotation", ctypes.c_double * 4), ("velocity", _double3),
                ("angular_velocity", _double3)]


class _StepError(ctypes.Structure):
    _fields_ = [(name, ctypes.c_double) for name in ("rms", "worst", "deflection")] + [("steps", ctypes.c_int64), ("known", ctypes.c_int32)]


class _Array(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("count", _size), ("components", _size), ("stride", _size)]


class _Events(ctypes.Structure):
    _fields_ = [("count", _size), ("what", ctypes.c_void_p), ("body", ctypes.c_void_p), ("on", ctypes.c_void_p), ("value", ctypes.c_void_p)]


class _Balls(ctypes.Structure):
    _fields_ = [("count", _size), ("first", _size), ("radius", ctypes.c_void_p), ("mass", ctypes.c_void_p)]


class _Hit(ctypes.Structure):
    _fields_ = [("body", _size), ("point", _double3), ("world", _double3), ("distance", ctypes.c_double)]


def _library():
    named = os.environ.get("BOUGH_LIBRARY")
    if named:
        return ctypes.CDLL(named)
    here = pathlib.Path(__file__).resolve()
    for folder in here.parents:  # PREFIX/lib/python3.11/site-packages/bough.py: the library is in PREFIX/lib or PREFIX/lib/<architecture>
        for pattern in ("libbough_files.so.*", "*-linux-gnu*/libbough_files.so.*", "lib/libbough_files.so.*", "lib/*/libbough_files.so.*",
                        "lib64/libbough_files.so.*"):
            for file in sorted(folder.glob(pattern)):
                return ctypes.CDLL(str(file))
        if (folder / "bin").is_dir() or folder.parent == folder.parent.parent:
            break
    name = ctypes.util.find_library("bough_files")
    if name is None:
        raise ImportError("bough: no libbough_files.so beside this file's installation or among the system's libraries; BOUGH_LIBRARY may name it")
    return ctypes.CDLL(name)


_c = _library()
_pointer, _string = ctypes.c_void_p, ctypes.c_char_p
_c.bough_abi.restype = ctypes.c_int32
if _c.bough_abi() != _ABI:
    raise ImportError(f"bough: the library's interface is of version {_c.bough_abi()}, this file's of {_ABI}; install both of one bough")
if not hasattr(_c, "bough_explain"):
    raise ImportError("bough: the library is older than this file; install both of one bough")
for _name, _result, _arguments in (
        ("version", _string, []), ("error", _string, []), ("free", None, [_pointer]), ("species", _string, [_size]),
        ("default_growth", _Growth, []), ("default_conversion", _Conversion, []), ("default_settings", _Settings, []),
        ("default_ground", _Ground, []), ("set_ground", int, [_pointer, _size, _pointer, ctypes.c_int32]),
        ("set_step", int, [_pointer, ctypes.c_double]), ("watch_error", int, [_pointer, ctypes.c_int32]), ("read_error", int, [_pointer] * 2),
        ("grow", int, [_pointer] * 2), ("read_splines", int, [_string, _size, _string, _pointer]), ("convert", int, [_pointer] * 3),
        ("read_tree", int, [_string, _size, _string, _pointer]), ("write_tree", int, [_pointer, _pointer, _size, _pointer]),
        ("tree_bodies", int, [_pointer] * 2), ("read_scene", int, [_string, _size, _string, _pointer]), ("scene_file", _string, [_pointer, _size]),
        ("scene_put", int, [_pointer, _size, _pointer]), ("scene_add", int, [_pointer, _pointer, _pointer, ctypes.c_double]),
        ("wind_preset", int, [_string, _pointer]), ("scene_set_wind", int, [_pointer] * 2), ("simulate", int, [_pointer] * 4),
        ("step", int, [_pointer] * 2), ("settle", int, [_pointer, ctypes.c_double]), ("settling_time", int, [_pointer] * 2), ("time", int, [_pointer] * 2), ("read", int, [_pointer, ctypes.c_int, _pointer]), ("read_events", int, [_pointer] * 2),
        ("read_broken", int, [_pointer] * 3), ("simulation_balls", int, [_pointer] * 2), ("posed_tree", int, [_pointer] * 2), ("explain", _string, [_pointer]),
        ("simulation_bodies", int, [_pointer] * 2), ("pick", int, [_pointer, _pointer, _pointer, ctypes.c_double, _pointer, _pointer]),
        ("pull", int, [_pointer, _size, _pointer, _pointer]),
        ("attach", int, [_pointer, _size, _pointer, ctypes.c_double, ctypes.c_double, _pointer]),
        ("move_attachment", int, [_pointer, ctypes.c_uint64, _pointer, ctypes.c_int32]),
        ("attachment_force", int, [_pointer, ctypes.c_uint64, _pointer]), ("release", int, [_pointer, ctypes.c_uint64]), ("set_wind", int, [_pointer] * 2), ("set_gravity", int, [_pointer] * 2),
        ("set_wood", int, [_pointer, ctypes.c_double, ctypes.c_double]), ("save", int, [_pointer, _pointer, _size, _pointer]),
        ("restore", int, [_pointer, _string, _size, _string]), ("hash", int, [_pointer] * 2)):
    _function = getattr(_c, "bough_" + _name)
    _function.restype = ctypes.c_int if _result in (int, None) else _result
    _function.argtypes = _arguments

__version__ = _c.bough_version().decode()


# What messages call by its name in C and C++, as it is called here.
_NAMES = ((r"settings\.(\w+) (asks for it|is not set)", r"Simulation(\1=True) \2"),
          (r"settings\.sleep", "Simulation(sleep=...)"), (r"bough_scene_(add|put) ", r"Scene.\1() "), (r"bough_watch_error\(\)", "watch_error()"),
          (r"^from: ", "origin: "))


def _check(result):
    if result != 0:
        kinds = {kind.code: kind for kind in (UsageError, InputError, NonFiniteError, OutputError)}
        message = _c.bough_error().decode(errors="replace")
        if kinds[result] is UsageError:  # others speak of documents
            for other, own in _NAMES:
                message = re.sub(other, own, message)
        raise kinds[result](message)


def _numbers(value, name, count):
    try:
        numbers = np.asarray(value, float)
    except (TypeError, ValueError):
        raise UsageError(f"{name}: is {value!r}, expected {'three' if count == 3 else 'four'} numbers") from None
    if numbers.shape != (count,):
        raise UsageError(f"{name}: has shape {numbers.shape}, expected ({count},)")
    return (ctypes.c_double * count)(*numbers)


def _vector(value, name):
    return _numbers(value, name, 3)


def _whole(value, name, least, most):
    try:
        number = value.__index__()
    except AttributeError:
        raise UsageError(f"{name}: is {value!r}, expected a whole number") from None
    if not least <= number <= most:
        raise UsageError(f"{name}: is {number}, expected {least} to {most}")
    return number


def _number(value, name):
    try:
        return float(value)
    except (TypeError, ValueError):
        raise UsageError(f"{name}: is {value!r}, expected a number") from None


def _text(value, name="name"):
    try:
        text = None if value is None else os.fsencode(value)
    except TypeError:
        text = b"\0"
    if text is not None and b"\0" in text:
        raise UsageError(f"{name}: is {value!r}, expected a name")
    return text


class _Handle:
    """One of the library's objects: freed with the last that uses it, arrays' memory among them."""

    def __init__(self, handle):
        self._handle = handle
        weakref.finalize(self, _c.bough_free, handle).atexit = False  # the process frees all; others may look at an array until then

    # Who copies would free the same handle twice, and number by number one of another process.
    def __reduce_ex__(self, protocol):
        raise TypeError(f"{type(self).__name__}: is neither copied nor pickled{self._instead}")

    _instead = ""

    def __setattr__(self, name, value):
        if hasattr(type(self), "set_" + name):
            raise AttributeError(f"{type(self).__name__}: {name} is changed by set_{name}()")
        super().__setattr__(name, value)

    def _view(self, address, shape, dtype):
        """Memory of this object as an array that keeps it alive."""
        if address is None or 0 in shape:
            return np.zeros(shape, dtype)
        return np.asarray(_Memory(self, address, shape, dtype))


class _Memory:
    """numpy asks this for the array, and keeps it as the array's base."""

    def __init__(self, owner, address, shape, dtype):
        self._owner = owner
        self.__array_interface__ = {"version": 3, "data": (address, True), "shape": shape, "typestr": np.dtype(dtype).str}


def _made(function, *arguments):
    handle = _pointer()
    _check(function(*arguments, ctypes.byref(handle)))
    return handle.value


def _content(source):
    """Bytes and a name of a file's name, bytes, or what has read()."""
    if hasattr(source, "read"):
        data, name = source.read(), getattr(source, "name", None)
        data = data.encode() if isinstance(data, str) else data
        if not isinstance(data, bytes):
            raise UsageError(f"source: its read() gives {type(data).__name__}, expected bytes")
        return data, name if isinstance(name, (str, bytes)) else None  # of a file without one a number
    if not isinstance(source, (str, os.PathLike)):
        try:
            return bytes(memoryview(source)), None
        except TypeError:
            raise UsageError(f"source: is {type(source).__name__}, expected a file's name, bytes, or what has read()") from None
    try:
        with pathlib.Path(source).open("rb") as file:
            if stat.S_IFMT(os.fstat(file.fileno()).st_mode) in (stat.S_IFCHR, stat.S_IFBLK):
                raise InputError(f"{source}: is a device, expected a file")
            return file.read(), source
    except OSError as error:
        raise InputError(f"{source or repr(source)}: {error.strerror}") from error
    except ValueError as error:  # a NUL in it
        raise InputError(f"{source!r}: {error}") from error


def _save(file, content):
    """All of it under that name, or what was there before. A link stays, as does a pipe or device, which gets the bytes."""
    known = os.stat(file) if os.path.exists(file) else None
    if known and not stat.S_ISREG(known.st_mode):
        pathlib.Path(file).write_bytes(content)
        return
    path = pathlib.Path(os.path.realpath(file))
    if known:
        path.open("r+b").close()  # refused where the file itself may not be written to
    beside = path.with_name(f".bough-{secrets.token_hex(8)}")
    try:
        with beside.open("xb") as made:
            if known:
                os.fchmod(made.fileno(), stat.S_IMODE(known.st_mode))
            made.write(content)
        os.replace(beside, path)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


class _HasBodies:
    """Arrays of bodies, one entry each, never written to."""

    def _body_arrays(self):
        found = _Bodies()
        _check((_c.bough_tree_bodies if isinstance(self, Tree) else _c.bough_simulation_bodies)(self._handle, ctypes.byref(found)))
        return found

    def _bodies_of(self, field, dtype, *components):
        found = self._body_arrays()
        return self._view(getattr(found, field), (found.count,) + components, dtype)

    @property
    def parents(self):
        """(bodies) int32: the parent's index, less than the body's own; -1: stands on the ground."""
        return self._bodies_of("parent", np.int32)

    @property
    def kinds(self):
        """(bodies) uint8: 0 branch, 1 leaf, 2 fruit, 3 petal."""
        return self._bodies_of("kind", np.uint8)

    @property
    def sizes(self):
        """(bodies, 3) [m]: branch: length, radius at its base, at its tip; leaf, petal: length, width, thickness; fruit: joint to centre,
        radius, radius."""
        return self._bodies_of("size", np.float64, 3)

    @property
    def masses(self):
        """(bodies) [kg]."""
        return self._bodies_of("mass", np.float64)

    @property
    def centers_of_mass(self):
        """(bodies, 3) [m] body frame."""
        return self._bodies_of("com", np.float64, 3)

    @property
    def stiffness(self):
        """(bodies, 3) [N m/rad] of joints: bend, bend, twist; leaf: flap, sway, twist."""
        return self._bodies_of("stiffness", np.float64, 3)

    @property
    def damping(self):
        """(bodies) [s] stiffness-proportional."""
        return self._bodies_of("damping", np.float64)

    @property
    def branches(self):
        """(bodies) int32: number of the branch that the body belongs to, or hangs on."""
        return self._bodies_of("branch", np.int32)

    @property
    def levels(self):
        """(bodies) int32: that branch's level, 0 for trunks."""
        return self._bodies_of("level", np.int32)


# --- Trees --------------------------------------------------------------------------------------------------------------------------------------

def species():
    """Names of the species that come with bough."""
    names = []
    while (name := _c.bough_species(len(names))) is not None:
        names.append(name.decode())
    return names


_KINDS = ("branch", "leaf", "fruit", "petal"), ("branches", "leaves", "fruit", "petals")


def _counted(count, one, many):
    return f"{count} {one if count == 1 else many}"


class _NeverChanges(_Handle):
    """A copy is itself."""

    def __copy__(self):
        return self

    def __deepcopy__(self, known):
        return self


class Splines(_NeverChanges):
    """A tree's branches as curves. From grow() or read_splines(), which leaves in notes what the file is, and what of it was guessed or put right."""
    notes = ()


class Tree(_NeverChanges, _HasBodies):
    """A tree as rigid bodies on joints; never changes. From convert() or read_tree(), which leaves in notes what another program's file is, and what of it
    was guessed or put right. len(tree): its bodies."""
    notes = ()
    _instead = ": to_bytes() is what read_tree() reads"

    def __len__(self):
        return self._body_arrays().count

    def __repr__(self):
        kinds = ", ".join(_counted(int(count), one, many) for count, one, many in zip(np.bincount(self.kinds, minlength=4), *_KINDS) if count)
        return f"Tree({_counted(len(self), 'body', 'bodies')}: {kinds}; {self.masses.sum():.4g} kg)"

    def to_bytes(self):
        """The tree as a document in safetensors, which bough's tools read."""
        return _written(_c.bough_write_tree, self._handle)

    def save(self, file):
        """Writes to_bytes() to a file, whose name ends in .safetensors by custom."""
        if not isinstance(file, (str, os.PathLike)):
            raise UsageError(f"file: is {type(file).__name__}, expected a file's name")
        try:
            _save(file, self.to_bytes())
        except OSError as error:
            raise OutputError(f"{file}: {error.strerror}") from error


def grow(species="broadleaf", bodies=0, seed=0, leaves=False, petals=False, fruit=False, age=0):
    """A tree of a species, as `treegen --species SPECIES --bodies BODIES --seed SEED --age AGE`. bodies: that convert() will make of it, within
    10 %; 0: as many as the species has. age [years]: 0.1 or more; 0: a mature tree. Returns Splines."""
    growth = _c.bough_default_growth()
    growth.species = _text(species, "species")
    growth.bodies = _whole(bodies, "bodies", 0, 2**63 - 1)
    growth.seed = _whole(seed, "seed", 0, 2**64 - 1)
    growth.age = _number(age, "age")
    growth.leaves, growth.petals, growth.fruit = bool(leaves), bool(petals), bool(fruit)
    return Splines(_made(_c.bough_grow, ctypes.byref(growth)))


def convert(splines, material=None, segment_length=0, max_bend=0.35, max_bodies=0):
    """Rigid bodies of the splines, as treeconvert. material: a preset of wood, None: the splines' own; segment_length [m]: of the longest
    body, above 0, or 0: by the splines; max_bend [rad]: largest turn of the curve in one body, 0.001 or more; max_bodies: 1 or more, or 0:
    as many as come. Returns a Tree."""
    if not isinstance(splines, Splines):
        raise UsageError(f"splines: is {type(splines).__name__}, expected Splines")
    conversion = _c.bough_default_conversion()
    conversion.material = _text(material, "material")
    conversion.segment_length = _number(segment_length, "segment_length")
    conversion.max_bend = _number(max_bend, "max_bend")
    conversion.max_bodies = _whole(max_bodies, "max_bodies", 0, 2**63 - 1)
    return Tree(_made(_c.bough_convert, splines._handle, ctypes.byref(conversion)))


@functools.cache
def _importer():
    """(libbough_imports, None), or (None, why there is none)."""
    folder, name = os.path.split(_c._name)
    try:
        library = ctypes.CDLL(os.path.join(folder, name.replace("bough_files", "bough_imports")))
        library.bough_import_notes.restype, library.bough_import_notes.argtypes = _string, []
        for kind in ("splines", "tree"):
            function = getattr(library, "bough_import_" + kind)
            function.restype, function.argtypes = ctypes.c_int, [_string, _size, _string, _string, _pointer]
        return library, None
    except (OSError, AttributeError) as error:
        return None, f"other programs' trees are read by libbough_imports, which cannot be loaded: {error}"


def _of_any_file(kind, source):
    """A Splines or Tree."""
    data, name = _content(source)
    library, missing = _importer()
    if library is None:
        try:
            return (Splines if kind == "splines" else Tree)(_made(getattr(_c, "bough_read_" + kind), data, len(data), _text(name)))
        except InputError as error:
            raise InputError(f"{error}; {missing}") from None
    folder = os.path.dirname(_text(name)) or b"." if isinstance(source, (str, os.PathLike)) else None
    made = (Splines if kind == "splines" else Tree)(_made(getattr(library, "bough_import_" + kind), data, len(data), _text(name), folder))
    notes = library.bough_import_notes().decode(errors="replace")
    made.notes = tuple(notes.split("\n")) if notes else ()
    return made


def read_splines(source):
    """Branches of a file's name, bytes, or what has read(): a bough-splines document or, where libbough_imports is installed, another program's tree, as
    read_tree(). For convert(), which has wood and lengths to choose."""
    return _of_any_file("splines", source)


def read_tree(source):
    """The tree of a file's name, bytes, or what has read(): a bough-tree document or, where libbough_imports is installed, another program's (SpeedTree's XML,
    scans, SWC, MTG, OBJ lines, Sapling's curves, ez-tree's branches, armatures of glTF), which moves as `treeconvert FILE | treesim -` moves it. FBX and COLLADA
    are refused with the line that has treeconvert read them. A file's own folder is where a .gltf's buffers are looked for; of bytes nothing else is opened."""
    return _of_any_file("tree", source)


# --- Scenes -------------------------------------------------------------------------------------------------------------------------------------

def wind_preset(name=None):
    """A Wind: "calm", "breeze", "gusty", "storm"; None: air that stands still, from which wind may rise."""
    wind = Wind()
    _check(_c.bough_wind_preset(_text(name, "wind"), ctypes.byref(wind)))
    return wind


def _wind(value):
    if isinstance(value, Wind):
        return value
    if isinstance(value, str):
        return wind_preset(value)
    raise UsageError(f"wind: is {value!r}, expected a Wind or a preset's name")


class Scene(_Handle):
    """Which trees stand where, and what acts on them. wind: a preset's name or a Wind."""

    def __init__(self, wind=None, document=None):
        """document: a bough-scene document's bytes, whose trees put() takes; see read_scene()."""
        data, name = (None, None) if document is None else _content(document)
        super().__init__(_made(_c.bough_read_scene, data, 0 if data is None else len(data), _text(name)))
        if wind is not None:
            self.set_wind(wind)

    def set_wind(self, wind):
        """A preset's name, a Wind, or None: none, not even the air's drag."""
        _check(_c.bough_scene_set_wind(self._handle, None if wind is None else ctypes.byref(_wind(wind))))

    def add(self, tree, position=(0, 0, 0), yaw=0):
        """One more tree: position (3) [m] on the ground, turned by yaw [deg] about +y."""
        _check(_c.bough_scene_add(self._handle, _tree(tree), _vector(position, "position"), _number(yaw, "yaw")))

    @property
    def files(self):
        """The files that the document names for its places, "" for a tree of add()."""
        names = []
        while (name := _c.bough_scene_file(self._handle, len(names))) is not None:
            names.append(os.fsdecode(name))
        return names

    def put(self, place, tree):
        """The tree of a place that the document names; place: its number in files."""
        _check(_c.bough_scene_put(self._handle, _whole(place, "place", 0, 2**32), _tree(tree)))


def _tree(tree):
    if not isinstance(tree, Tree):
        raise UsageError(f"tree: is {type(tree).__name__}, expected Tree")
    return tree._handle


def read_scene(file, outside=False):
    """A bough-scene document with its trees, each file once. outside: trees may stand elsewhere than in the document's folder and below it."""
    if not isinstance(file, (str, os.PathLike)):
        raise UsageError(f"file: is {type(file).__name__}, expected a file's name, beside which its trees are; Scene(document=...) takes bytes")
    scene = Scene(document=file)
    folder, known = pathlib.Path(file).parent, {}
    for place, name in enumerate(scene.files):
        if name not in known:
            if not outside and not (folder / name).resolve().is_relative_to(folder.resolve()):
                raise InputError(f"{file}: /trees: names '{name}', which leads out of the folder of the file that names it; outside=True lets it")
            if (folder / name).exists() and not (folder / name).is_file() and not (folder / name).is_dir():
                raise InputError(f"{file}: /trees: names '{name}', which is no regular file, expected one: what a file names is not read from a pipe or device")
            known[name] = read_tree(folder / name)
        scene.put(place, known[name])
    return scene


# --- Simulations --------------------------------------------------------------------------------------------------------------------------------

Report = collections.namedtuple("Report", [name for name, _ in _Report._fields_])
Report.__doc__ = """What a step says: steps taken, time [s]; numbers of bodies that in this step turned by more than a radian (fast_turns), were kept from
gaining energy (guarded), ended at a joint's limit (limited); events (broke, hits, landed)."""
StepError = collections.namedtuple("StepError", [name for name, _ in _StepError._fields_])
StepError.__doc__ = """How wrong a run is for the length of its steps, over the tips of its branches: rms, worst [m], 0.9 to 1.8 times the true error; deflection
[m] RMS of how far the tips are from where they were drawn; steps that were compared; known (False: the companion's own steps are too coarse to tell)."""
Hit = collections.namedtuple("Hit", "body point world distance")
Hit.__doc__ = "What a ray met: body, point (3) [m] in its frame, world (3) [m], distance [m]."
Events = collections.namedtuple("Events", "what body on value")
Events.__doc__ = """Of the last step, arrays over events: what ("broke", "hit", "landed", "leapt"), body, on (-1: the ground, or nothing), value (broke: torque
[N m]; hit: impulse [N s]; landed, leapt: speed [m/s])."""
Balls = collections.namedtuple("Balls", "first radii masses")
Balls.__doc__ = """What is thrown at the trees, then walkers: the first one's number in positions, where all are behind the trees' bodies; radii (balls) [m], masses
(balls) [kg]."""
_EVENTS = ("broke", "hit", "landed", "leapt")


def _written(function, handle):
    size = _size()
    _check(function(handle, None, 0, ctypes.byref(size)))
    buffer = ctypes.create_string_buffer(size.value)
    _check(function(handle, buffer, size, ctypes.byref(size)))
    return buffer.raw


class Simulation(_Handle, _HasBodies):
    """One run of a scene. len(run): bodies that positions has."""

    _instead = ": Simulation(scene, before=run) is another one that goes on; save() is what restore() takes"

    def __init__(self, scene, step=1 / 30, precision="double", method="coupled", sleep=0, threads=0, velocities=False, torques=False, stresses=False,
                 pulls=False, grounds=False, portable=False, before=None):
        """step [s] of one step(). precision "double" or "float" (or "single": twice as fast; arrays are doubles with both). method "coupled" or "analytic". sleep
        [rad/s]: slower than this for a while, trees are left out; 0: never. threads of a step at most; 0: as many as there are cores. velocities,
        torques, stresses: are wanted; pulls: pull() will be called; grounds: set_ground() will be. portable: the same on every machine, several times slower. before: another Simulation, whose
        trees' motion goes on where trees are connected alike."""
        if not isinstance(scene, Scene):
            raise UsageError(f"scene: is {type(scene).__name__}, expected Scene")
        if before is not None and not isinstance(before, Simulation):
            raise UsageError(f"before: is {type(before).__name__}, expected Simulation")
        settings = _c.bough_default_settings()
        settings.step = _number(step, "step")
        settings.sleep = _number(sleep, "sleep")
        settings.threads = _whole(threads, "threads", 0, 2**31 - 1)
        for field, value, names in (("precision", "float" if precision == "single" else precision, ("float", "double")), ("method", method, ("coupled", "analytic"))):
            if value not in names:
                raise UsageError(f"{field}: is {value!r}, expected {' or '.join(names)}")
            setattr(settings, field, names.index(value))
        for field, value in (("velocities", velocities), ("torques", torques), ("stresses", stresses), ("pulls", pulls), ("grounds", grounds), ("portable", portable)):
            setattr(settings, field, bool(value))
        super().__init__(_made(_c.bough_simulate, scene._handle, ctypes.byref(settings), None if before is None else before._handle))

    def __len__(self):
        return self._array(0).count

    def __repr__(self):
        ends = [height[:, 1].max() for height in (self.positions, self.tips) if len(height)]
        return f"Simulation({_counted(len(self), 'body', 'bodies')}, up to {max(ends):.4g} m high, time={self.time:.6g} s)"

    @property
    def time(self):
        """[s] of the present state."""
        found = ctypes.c_double()
        _check(_c.bough_time(self._handle, ctypes.byref(found)))
        return found.value

    def settle(self, seconds=None):
        """Before the first step: the wind has blown for so many seconds already, 600 at most; None: until a start at rest is forgotten. Returns them."""
        if seconds is None:
            found = ctypes.c_double()
            _check(_c.bough_settling_time(self._handle, ctypes.byref(found)))
            seconds = found.value
        seconds = _number(seconds, "seconds")
        _check(_c.bough_settle(self._handle, seconds))
        return seconds

    def step(self):
        """From now to now + step. Returns a Report; raises NonFiniteError, and then at each further step."""
        report = _Report()
        _check(_c.bough_step(self._handle, ctypes.byref(report)))
        return Report(*(getattr(report, name) for name in Report._fields))

    def _array(self, field):
        found = _Array()
        _check(_c.bough_read(self._handle, field, ctypes.byref(found)))
        return found

    def _read(self, field):
        found = self._array(field)
        return self._view(found.data, (found.count, found.components), np.float64)

    @property
    def positions(self):
        """(bodies, 3) [m] of own joints (balls: centres), world."""
        return self._read(0)

    @property
    def rotations(self):
        """(bodies, 4) x, y, z, w, world from body."""
        return self._read(1)

    @property
    def velocities(self):
        """(bodies, 3) [m/s] of centres of mass (Simulation(velocities=True))."""
        return self._read(2)

    @property
    def angular_velocities(self):
        """(bodies, 3) [rad/s] world (Simulation(velocities=True))."""
        return self._read(3)

    @property
    def angles(self):
        """(trees' bodies, 3) [rad] rotation vectors of joints, joint frames."""
        return self._read(4)

    @property
    def rates(self):
        """(trees' bodies, 3) [rad/s] how angles change."""
        return self._read(5)

    @property
    def torques(self):
        """(trees' bodies, 3) [N m] of springs and dampers on bodies, joint frames (Simulation(torques=True))."""
        return self._read(6)

    @property
    def stresses(self):
        """(trees' bodies, 1) [Pa] that bend the wood at joints, 0 of all but branches (Simulation(stresses=True))."""
        return self._read(7)

    @property
    def tips(self):
        """(bodies, 3) [m] far ends of the trees' bodies, world; an array of its own."""
        count = len(self.parents)
        turned = self.rotations[:count]
        x, y, z, w = turned.T
        ahead = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], 1)
        return self.positions[:count] + self.sizes[:, :1] * ahead

    @property
    def first_bodies(self):
        """(trees + 1) where each tree's bodies begin; the last entry: how many there are."""
        found = self._body_arrays()
        return self._view(found.first_body, (found.trees + 1,), np.uintp)

    @property
    def events(self):
        """Events of the last step; arrays of their own."""
        found = _Events()
        _check(_c.bough_read_events(self._handle, ctypes.byref(found)))
        view = lambda field, dtype: self._view(getattr(found, field), (found.count,), dtype).copy()
        return Events([_EVENTS[k] for k in view("what", np.int32)], view("body", np.int32), view("on", np.int32), view("value", np.float64))

    @property
    def broken(self):
        """(joints) uint32: bodies whose joints broke since the start, in that order; an array of its own."""
        found, count = _pointer(), _size()
        _check(_c.bough_read_broken(self._handle, ctypes.byref(found), ctypes.byref(count)))
        return self._view(found.value, (count.value,), np.uint32).copy()

    @property
    def balls(self):
        """Balls: what the scene's document throws or sends at the trees."""
        found = _Balls()
        _check(_c.bough_simulation_balls(self._handle, ctypes.byref(found)))
        return Balls(found.first, *(self._view(getattr(found, field), (found.count,), np.float64) for field in ("radius", "mass")))

    def posed_tree(self):
        """The trees as they stand now, joined in one Tree: drawn so, at rest so in a scene at the origin. Not where joints broke or are held."""
        return Tree(_made(_c.bough_posed_tree, self._handle))

    def explain(self):
        """Which stages and arrays the scene needs, and why: the text of `treesim --report plan`."""
        text = _c.bough_explain(self._handle)
        if text is None:
            raise Error(_c.bough_error().decode(errors="replace"))
        return text.decode()

    def pick(self, origin, direction, aperture=0):
        """The first of the trees' bodies that a ray from origin (3) [m] along direction (3) meets; where it meets none, the one whose axis is least
        off it, up to aperture [rad]. A Hit, or None."""
        hit, found = _Hit(), ctypes.c_int32()
        _check(_c.bough_pick(self._handle, _vector(origin, "origin"), _vector(direction, "direction"), _number(aperture, "aperture"),
                             ctypes.byref(hit), ctypes.byref(found)))
        return Hit(hit.body, np.array(hit.point), np.array(hit.world), hit.distance) if found.value else None

    def pull(self, body, point, force):
        """A force (3) [N], world, on a point (3) [m] of a body, body frame, in the next step alone (Simulation(pulls=True))."""
        _check(_c.bough_pull(self._handle, _whole(body, "body", 0, 2**63), _vector(point, "point"), _vector(force, "force")))

    def attach(self, body, point, stiffness, damping=0):
        """A hand, a rope, a prop: a spring [N/m] and a damper [N s/m] between a point (3) [m] of a body, body frame, and a target in the world, which is
        where the point is now. Any stiffness holds. Returns the attachment's number, this simulation's own; until release(), or till the body breaks off."""
        number = ctypes.c_uint64()
        _check(_c.bough_attach(self._handle, _whole(body, "body", 0, 2**63), _vector(point, "point"), _number(stiffness, "stiffness"),
                               _number(damping, "damping"), ctypes.byref(number)))
        return number.value

    def move_attachment(self, attachment, target, steps=1):
        """Its target goes evenly to a place (3) [m], world, in the next `steps` steps, and stays there; 0: is there at once."""
        _check(_c.bough_move_attachment(self._handle, _whole(attachment, "attachment", 0, 2**64 - 1), _vector(target, "target"),
                                        _whole(steps, "steps", 0, 2**31 - 1)))

    def attachment_force(self, attachment):
        """(3) [N] on the body, world, at the last step's end."""
        force = _double3()
        _check(_c.bough_attachment_force(self._handle, _whole(attachment, "attachment", 0, 2**64 - 1), force))
        return np.array(force)

    def release(self, attachment):
        """Lets go."""
        _check(_c.bough_release(self._handle, _whole(attachment, "attachment", 0, 2**64 - 1)))

    def set_wind(self, wind):
        """A preset's name or a Wind, from the next step on; the scene began with one (wind_preset() at least)."""
        _check(_c.bough_set_wind(self._handle, ctypes.byref(_wind(wind))))

    def set_gravity(self, gravity):
        """(3) [m/s^2], from the next step on."""
        _check(_c.bough_set_gravity(self._handle, _vector(gravity, "gravity")))

    def set_wood(self, stiffness=1, damping=1):
        """All joints' stiffness and damping over what they had when the run began. Springs keep their rest, so softer wood sags further and stiffer wood
        rises. Another Simulation(before=run) keeps the pose as drawn, of a scene whose document has the stiffness_scale that is wanted."""
        _check(_c.bough_set_wood(self._handle, _number(stiffness, "stiffness"), _number(damping, "damping")))

    def set_step(self, step):
        """[s] of the steps from here on; the time goes on from what it is."""
        _check(_c.bough_set_step(self._handle, _number(step, "step")))

    def set_ground(self, tree, position=(0, 0, 0), rotation=(0, 0, 0, 1), velocity=(0, 0, 0), angular_velocity=(0, 0, 0), steps=1):
        """The ground under a tree (its number from 0 on; Simulation(grounds=True)), its roots with it: `steps` steps from now its place has moved by position
        (3) [m] and turned by rotation (4) x, y, z, w from where it was drawn, at velocity (3) [m/s] and angular_velocity (3) [rad/s]; 0: at once."""
        ground = _c.bough_default_ground()
        ground.rotation = _numbers(rotation, "rotation", 4)
        for name, value in (("position", position), ("velocity", velocity), ("angular_velocity", angular_velocity)):
            setattr(ground, name, _vector(value, name))
        _check(_c.bough_set_ground(self._handle, _whole(tree, "tree", 0, 2**63), ctypes.byref(ground), _whole(steps, "steps", -2**31, 2**31 - 1)))

    def watch_error(self, on=True):
        """From the next step on a companion at a quarter of the step goes beside, and a step costs five; error has what it finds."""
        _check(_c.bough_watch_error(self._handle, bool(on)))

    @property
    def error(self):
        """StepError, since watch_error()."""
        found = _StepError()
        _check(_c.bough_read_error(self._handle, ctypes.byref(found)))
        return StepError(found.rms, found.worst, found.deflection, found.steps, bool(found.known))

    def save(self):
        """The state as bytes, as `treesim --save-state` writes it. NonFiniteError where it is not finite any more."""
        return _written(_c.bough_save, self._handle)

    def restore(self, state):
        """Goes on from what save() gave, or a file or bytes of `treesim --save-state`."""
        data, name = _content(state)
        _check(_c.bough_restore(self._handle, data, len(data), _text(name)))

    def hash(self):
        """What `treesim --report hash` prints: 16 hexadecimal digits."""
        value = ctypes.c_uint64()
        _check(_c.bough_hash(self._handle, ctypes.byref(value)))
        return f"{value.value:016x}"
