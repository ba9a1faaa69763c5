"""bough.py against the tools' documents, read here with json, against geometry, and against itself where it must not differ. Run by python.sh in a folder
that has birch.json (a tree), park.json (a scene of it), birch.jsonl (its motion), park.hash, birch.state. Prints nothing where all is well."""
import contextlib
import copy
import gc
import json
import math
import os
import pathlib
import pickle
import resource
import signal
import tempfile
import threading
import types
import weakref

import numpy as np

import bough


def raises(kind, text, call):
    try:
        call()
    except bough.Error as error:
        assert type(error) is kind, f"{type(error)}: {error}"
        assert text in str(error), f"{text!r} is not in {str(error)!r}"
        assert error.code == {"UsageError": 1, "InputError": 2, "NonFiniteError": 3, "OutputError": 4}[kind.__name__]
        return
    raise AssertionError(f"nothing was raised, expected {kind.__name__}: {text}")


def address(array):
    return array.__array_interface__["data"][0]


def rotated(q, v):
    """By the definition q v q*, not as bough.py does it."""
    def product(a, b):
        ax, ay, az, aw = np.moveaxis(a, -1, 0)
        bx, by, bz, bw = np.moveaxis(b, -1, 0)
        return np.stack([aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw,
                         aw * bw - ax * bx - ay * by - az * bz], -1)
    pure = np.concatenate([v, np.zeros(v.shape[:-1] + (1,))], -1)
    return product(product(q, pure), q * [-1, -1, -1, 1])[..., :3]


def of(tree, wind="gusty", **options):
    scene = bough.Scene(wind=wind)
    scene.add(tree)
    return bough.Simulation(scene, **options)


tree = bough.read_tree("birch.json")
with open("birch.json") as file:
    document = json.load(file)

# A tree's arrays are the document's numbers.
assert len(tree) == len(document["parent"])
for mine, key in ((tree.parents, "parent"), (tree.sizes, "size"), (tree.masses, "mass"), (tree.centers_of_mass, "com"), (tree.stiffness, "stiffness"),
                  (tree.damping, "damping"), (tree.branches, "branch"), (tree.levels, "level")):
    assert np.array_equal(mine.ravel(), np.ravel(document[key])), key
    assert len(mine) == len(tree) and not mine.flags.writeable and not mine.flags.owndata, key
assert bough.read_tree(tree.to_bytes()).stiffness.tolist() == tree.stiffness.tolist()
tree.save("saved.safetensors")
with open("birch.json", "rb") as file:
    assert len(bough.read_tree(file)) == len(tree)

# The motion is what treesim wrote, number for number; bodies that go on along a branch hang where the one before ends.
run = of(tree, velocities=True, torques=True, stresses=True)
joined = np.flatnonzero((tree.parents >= 0) & (tree.kinds == 0) & (tree.branches == tree.branches[tree.parents]))
assert len(joined) > 20
before = run.positions
at = address(before)
with open("birch.jsonl") as file:
    frames = [json.loads(line) for line in file]
frames = [frame for frame in frames if "position" in frame]
assert len(frames) == 15
for k, frame in enumerate(frames):
    if k > 0:
        report = run.step()
        assert report.steps == k and math.isclose(report.time, k / 30)
    for mine, key in ((run.positions, "position"), (run.rotations, "rotation"), (run.velocities, "velocity"),
                      (run.angular_velocities, "angular_velocity")):
        assert np.array_equal(mine.ravel(), np.ravel(frame[key])), (k, key)
    assert np.abs(run.positions[joined] - run.tips[tree.parents[joined]]).max() < 1e-9
    assert np.allclose(run.tips, run.positions + rotated(run.rotations, np.outer(tree.sizes[:, 0], [0, 0, 1])), atol=1e-12)
assert run.angles.shape == run.rates.shape == run.torques.shape == (len(tree), 3)
assert run.stresses.shape == (len(tree), 1)

# Views: no copy, not to be written to, the same memory from step to step, alive as long as one of them.
assert address(run.positions) == at and np.array_equal(before, run.positions)
try:
    before[0] = 1
except ValueError:
    pass
else:
    raise AssertionError("a view was written to")
alive = weakref.ref(run)
part = run.positions[3:7, 1]
expected = part.copy()
del run, before, mine
gc.collect()
assert alive() is not None and np.array_equal(part, expected)
del part
gc.collect()
assert alive() is None
young, grown = bough.convert(bough.grow("birch", age=8)), bough.convert(bough.grow("birch", age=16))
assert len(young) < len(grown) and of(young).positions[:, 1].max() < 0.8 * of(grown).positions[:, 1].max()
sizes = bough.convert(bough.grow("palm", bodies=50)).sizes  # the tree has gone, its numbers have not
gc.collect()
assert np.isfinite(sizes).all() and (sizes >= 0).all()

# A scene's document with its trees; the hash is treesim's.
run = bough.Simulation(bough.read_scene("park.json"), precision="single")
assert bough.read_scene("park.json").files == ["birch.json", "birch.json"]
assert run.first_bodies.tolist() == [0, len(tree), 2 * len(tree)]
for _ in range(14):
    run.step()
assert run.hash() == pathlib.Path("park.hash").read_text().split()[-1], run.hash()

# Settled, it begins in the wind's sway.
calm, swaying = bough.Simulation(bough.read_scene("park.json")), bough.Simulation(bough.read_scene("park.json"))
assert 2 <= swaying.settle() <= 20 and calm.hash() != swaying.hash()
for seconds in (-1, math.nan, 1e12):
    raises(bough.UsageError, "expected 0 to 600", lambda: calm.settle(seconds))
raises(bough.UsageError, "seconds: is 'a', expected a number", lambda: calm.settle("a"))

# A state of treesim's goes on here, one of ours bit by bit.
run = of(tree)
run.restore("birch.state")
other = of(tree)
for _ in range(14):
    other.step()
assert run.hash() == other.hash()
state = other.save()
other.step()
run.restore(state)
run.step()
assert run.hash() == other.hash()
raises(bough.InputError, "<memory>", lambda: run.restore(b"{}"))

# Picked, pulled, it comes along; let go, a quarter of the pull at most is left after 20 s in still air.
run = of(tree, wind=None, pulls=True)
rest = run.tips.copy()
end = int(np.argmax(np.where(tree.kinds == 0, rest[:, 1], 0)))
hit = run.pick(rest[end] + [9, 0, 0], [-3, 0, 0], 0.02)
assert hit is not None and np.linalg.norm(hit.world - rest[end]) < 0.3
assert run.pick(rest[end] + [9, 0, 0], [3, 0, 0]) is None
spot = lambda: run.positions[hit.body] + rotated(run.rotations[hit.body], hit.point)
assert np.allclose(spot(), hit.world)
for _ in range(30):
    run.pull(hit.body, hit.point, [0, 0, 0.02])
    run.step()
moved = (spot() - hit.world)[2]
assert moved > 1e-4, moved
for _ in range(600):
    run.step()
assert abs((spot() - hit.world)[2]) < moved / 4

# A hand takes hold without anything asked for, is followed, says how hard it pulls, and lets go.
run = of(tree, wind=None)
run.step()
here = run.positions[hit.body] + rotated(run.rotations[hit.body], hit.point)
hand = run.attach(hit.body, hit.point, 1e6, 1)
run.move_attachment(hand, here + [0, 0, 0.02], 10)
for _ in range(60):
    run.step()
assert np.allclose(run.positions[hit.body] + rotated(run.rotations[hit.body], hit.point), here + [0, 0, 0.02], atol=2e-3)
assert run.attachment_force(hand)[2] > 0
run.release(hand)
raises(bough.UsageError, "was released", lambda: run.attachment_force(hand))
raises(bough.UsageError, "holds nothing", lambda: run.attach(0, [0, 0, 0], 0))
raises(bough.UsageError, "steps: is -1", lambda: run.move_attachment(hand, here, -1))

# What may change in a run.
run = of(tree, wind=bough.wind_preset())
for _ in range(5):
    run.step()
still = np.abs(run.rates).max()
wind = bough.wind_preset("storm")
wind.velocity = [0, 0, 15]
run.set_wind(wind)
run.set_gravity([0, -9, 0])
run.set_wood(0.8, 1.2)
for _ in range(20):
    run.step()
assert np.abs(run.rates).max() > 100 * still
assert wind.velocity.tolist() == [0, 0, 15] and "gust_factor" in repr(wind)
# What would be lost is refused: one number of a copy, a name that a wind has not.
for lost, kind in ((lambda: wind.velocity.__setitem__(0, 20), ValueError), (lambda: setattr(wind, "speed", 3), AttributeError)):
    try:
        lost()
    except kind as error:
        assert kind is ValueError or str(error).startswith("Wind: has no speed, expected velocity, reference_height"), error
    else:
        raise AssertionError("a wind took what it has no place for")
wind.turbulence = 0.25
assert wind.turbulence == 0.25
assert f"Tree({len(tree)} bodies: {np.sum(tree.kinds == 0)} branches, {np.sum(tree.kinds == 1)} leaves; {tree.masses.sum():.4g} kg)" == repr(tree)
assert repr(run).startswith(f"Simulation({len(tree)} bodies, up to ") and repr(run).endswith(f" m high, time={25 / 30:.6g} s)"), repr(run)
assert math.isclose(run.time, 25 / 30)
following = bough.Simulation((lambda s: (s.add(tree), s)[1])(bough.Scene()), before=run)
assert np.abs(following.positions - run.positions).max() < 1e-3

# Steps of another length; the time goes on. A run that begins so is the same.
run, begun = of(tree, step=1 / 30), of(tree, step=1 / 60)
run.set_step(1 / 60)
for _ in range(4):
    assert run.step().time == begun.step().time
assert run.hash() == begun.hash()
run.set_step(0.01)
assert abs(run.step().time - 4 / 60 - 0.01) < 1e-12
raises(bough.UsageError, "set_step: is 0", lambda: run.set_step(0))

# A ground that is carried a metre takes the tree along; what is read is where it is.
run = of(tree, wind=None, grounds=True)
rest = run.positions.copy()
run.set_ground(0, position=[1, 0, 0], steps=60)
for _ in range(60):
    run.step()
assert np.allclose(run.positions[0] - rest[0], [1, 0, 0], atol=1e-9)
assert np.abs(run.positions - rest - [1, 0, 0]).max() > 1e-4  # and it sways
raises(bough.UsageError, "set_ground: Simulation(grounds=True) is not set", lambda: of(tree).set_ground(0))
raises(bough.UsageError, "rotation: has shape (3,)", lambda: run.set_ground(0, rotation=[0, 0, 1]))
for none in ("abc", {}, [0, 0, 0, "w"], None):
    raises(bough.UsageError, f"rotation: {'has shape ()' if none is None else f'is {none!r}'}, expected ", lambda: run.set_ground(0, rotation=none))
raises(bough.UsageError, "tree 1 is not there", lambda: run.set_ground(1))

# The step's error: at half the step, less than half of it.
def error_of(step, count):
    run = of(bough.convert(bough.grow("pine", bodies=300, seed=1)), step=step)
    raises(bough.UsageError, "is not watched; watch_error() begins it", lambda: run.error)
    run.watch_error()
    for _ in range(count):
        run.step()
    assert run.error.steps == count and run.error.known is True and run.error.worst >= run.error.rms > 0
    assert run.error.deflection > run.error.rms
    return run.error.rms
assert error_of(1 / 60, 60) < error_of(1 / 30, 30) / 2
broken = bough.Scene(document=b'{"format": "bough-scene", "version": 1, "trees": [{"file": "t"}], "fracture": {"leaf": 1e-9}}')
broken.put(0, tree)
run = bough.Simulation(broken)
report = run.step()
assert report.broke > 0 and run.events.what.count("broke") == report.broke
assert (tree.kinds[run.events.body] == 1).all() and (run.events.value > 0).all()
assert run.broken.tolist() == run.events.body[np.array(run.events.what) == "broke"].tolist() and len(run.balls.radii) == 0
raises(bough.UsageError, "joints broke in this run", run.posed_tree)

# What is thrown stands behind the trees' bodies, as the document throws it.
thrown = bough.Scene(document=b'{"format": "bough-scene", "version": 1, "trees": [{"file": "t"}], "balls": [{"position": [3, 9, 0], "radius": 0.2, "mass": 2}]}')
thrown.put(0, tree)
run = bough.Simulation(thrown)
assert run.balls.first == len(tree) and run.balls.radii.tolist() == [0.2] and run.balls.masses.tolist() == [2] and len(run.broken) == 0
assert run.positions[run.balls.first:].tolist() == [[3, 9, 0]]

# A tree as it stands is drawn so, and stays; the plan is what treesim prints of it, which lets trees sleep and counts calls.
run = of(tree, wind="storm")
stages = lambda text: [line.split("; no sleep")[0] for line in text.splitlines() if line.startswith("stage ")]
assert len(stages(run.explain())) > 15 and stages(run.explain()) == stages(pathlib.Path("storm.plan").read_text())
for _ in range(20):
    run.step()
stands = run.positions.copy()
posed = of(run.posed_tree(), wind=None)
for _ in range(20):
    assert np.abs(posed.positions - stands).max() < 1e-6
    posed.step()

# Threads of their own.
hashes = []
def alone():
    own = of(tree)
    for _ in range(10):
        own.step()
    hashes.append(own.hash())
threads = [threading.Thread(target=alone) for _ in range(8)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
assert len(hashes) == 8 and len(set(hashes)) == 1

# Other programs' trees move as treesim moves what treeconvert makes of them, from a file's name and from bytes; what is cut off is refused or a smaller tree.
def moved(tree):
    run = of(tree)
    for _ in range(5):
        run.step()
    return run.hash()


imports = dict(line.split() for line in pathlib.Path("imports.hashes").read_text().splitlines())
assert len(imports) == 10
for file, wanted in imports.items():
    foreign = bough.read_tree(file)
    assert moved(foreign) == wanted and foreign.notes, file
    data = pathlib.Path(file).read_bytes()
    assert moved(bough.convert(bough.read_splines(file))) == wanted, file
    if not file.endswith("twig_armature.gltf"):
        assert moved(bough.read_tree(data)) == wanted, file
    for cut in range(0, len(data), len(data) // 37 + 1):
        for bad in (data[:cut], data[:cut] + b"\xff" + data[cut + 1:], data[cut:]):
            try:
                bough.read_tree(bad)
            except bough.InputError as error:
                assert str(error).startswith("<memory>"), error
assert "SpeedTree raw XML" in bough.read_tree("imports/young_maple.xml").notes[0] and tree.notes == ()
assert len(bough.convert(bough.read_splines("imports/young_maple.xml"), material="northern-red-oak")) > 100
raises(bough.InputError, "is a COLLADA model, which the tools alone read; by hand: treeconvert imports/moved_armature.dae -o moved_armature.tree.json",
       lambda: bough.read_tree("imports/moved_armature.dae"))
raises(bough.InputError, "treeconvert FILE -o tree.json", lambda: bough.read_tree(pathlib.Path("imports/moved_armature.dae").read_bytes()))
raises(bough.InputError, "is compressed (EXT_meshopt_compression), which the tools alone read", lambda: bough.read_tree("imports/twig_meshopt.glb"))
raises(bough.InputError, "was read from a pipe or from memory", lambda: bough.read_tree(pathlib.Path("imports/twig_armature.gltf").read_bytes()))

# Refusals, each with its message.
raises(bough.UsageError, "is 'yggdrasil', expected one of broadleaf, apple", lambda: bough.grow("yggdrasil"))
raises(bough.UsageError, "bodies: is -1", lambda: bough.grow("apple", bodies=-1))
raises(bough.UsageError, "age: is 0.05", lambda: bough.grow("apple", age=0.05))
raises(bough.UsageError, "seed: is 1.5, expected a whole number", lambda: bough.grow("apple", seed=1.5))
raises(bough.UsageError, "splines: is Tree, expected Splines", lambda: bough.convert(tree))
raises(bough.UsageError, "material: is 'iron'", lambda: bough.convert(bough.grow("palm", bodies=50), material="iron"))
raises(bough.InputError, "none.json: No such file", lambda: bough.read_tree("none.json"))
raises(bough.InputError, "park.json", lambda: bough.read_tree("park.json"))
pathlib.Path("below").mkdir()
pathlib.Path("below/scene.json").write_text('{"format": "bough-scene", "version": 1, "trees": [{"file": "../birch.json"}]}')
raises(bough.InputError, "names '../birch.json', which leads out of the folder", lambda: bough.read_scene("below/scene.json"))
assert bough.read_scene("below/scene.json", outside=True).files == ["../birch.json"]
# What would be waited for or read without end is not begun. (Before, a pipe hung and a device took all the memory.)
@contextlib.contextmanager
def at_most(kind, amount):
    before = resource.getrlimit(kind)
    resource.setrlimit(kind, (amount, before[1]))
    yield
    resource.setrlimit(kind, before)


os.mkfifo("below/pipe")
pathlib.Path("below/piped.json").write_text('{"format": "bough-scene", "version": 1, "trees": [{"file": "pipe"}]}')
signal.alarm(20)
raises(bough.InputError, "below/piped.json: /trees: names 'pipe', which is no regular file, expected one: what a file names is not read from a pipe or device",
       lambda: bough.read_scene("below/piped.json"))
signal.alarm(0)
with at_most(resource.RLIMIT_AS, 4 << 30):
    raises(bough.InputError, "/dev/zero: is a device, expected a file", lambda: bough.read_tree("/dev/zero"))

# A file is saved whole, or stays as it was, with its permissions; a link stays one; a pipe gets the bytes.
os.chmod("saved.safetensors", 0o640)
kept = pathlib.Path("saved.safetensors").read_bytes()
os.symlink("saved.safetensors", "link.safetensors")
here = sorted(os.listdir())
small = bough.convert(bough.grow("palm", bodies=50))
with at_most(resource.RLIMIT_FSIZE, 1000):
    raises(bough.OutputError, "saved.safetensors: File too large", lambda: small.save("saved.safetensors"))
assert pathlib.Path("saved.safetensors").read_bytes() == kept and sorted(os.listdir()) == here
small.save("link.safetensors")
assert os.path.islink("link.safetensors") and pathlib.Path("saved.safetensors").read_bytes() == small.to_bytes() != kept
assert os.stat("saved.safetensors").st_mode & 0o777 == 0o640 and sorted(os.listdir()) == here
got = []
reader = threading.Thread(target=lambda: got.append(pathlib.Path("below/pipe").read_bytes()))
reader.start()
small.save("below/pipe")
reader.join()
assert got == [small.to_bytes()]
tree.save("saved.safetensors")
raises(bough.UsageError, "has no tree; Scene.add() gives it one", lambda: bough.Simulation(bough.Scene()))
raises(bough.UsageError, "wind: is 'gale'", lambda: bough.Scene(wind="gale"))
raises(bough.UsageError, "position: has shape (2,)", lambda: bough.Scene().add(tree, (0, 0)))
raises(bough.UsageError, "position: is not finite", lambda: bough.Scene().add(tree, (0, math.nan, 0)))
raises(bough.UsageError, "step: is -1", lambda: of(tree, step=-1))
raises(bough.UsageError, "precision: is 'half', expected float or double", lambda: of(tree, precision="half"))
assert of(tree, precision="single").hash() == of(tree, precision="float").hash()
raises(bough.UsageError, "Simulation(velocities=True) asks for it", lambda: of(tree).velocities)
raises(bough.UsageError, "body 100000 is not there", lambda: of(tree, pulls=True).pull(100000, [0, 0, 0], [1, 0, 0]))
raises(bough.UsageError, "pull: Simulation(pulls=True) is not set", lambda: of(tree).pull(0, [0, 0, 0], [1, 0, 0]))
raises(bough.UsageError, "origin: is 'a', expected three numbers", lambda: of(tree).pick("a", [0, 0, 1]))
raises(bough.UsageError, "origin: is not finite", lambda: of(tree).pick([0, math.nan, 0], [0, 0, 1]))
raises(bough.UsageError, "species: is 5, expected a name", lambda: bough.grow(5))
raises(bough.UsageError, "species: is 'apple\\x00x', expected a name", lambda: bough.grow("apple\0x"))
raises(bough.UsageError, "file: is int, expected a file's name", lambda: tree.save(5))
raises(bough.InputError, "'': Is a directory", lambda: bough.read_tree(""))
for wrong, value in ("seed", -1), ("seed", 2**70), ("turbulence", "a"):
    raises(bough.UsageError, f"{wrong}: is ", lambda: setattr(bough.wind_preset("gusty"), wrong, value))
again = of(tree)
again.restore(np.frombuffer(of(tree).save(), np.uint8))

# Who copies gets the same tree, whose memory lasts as long; of what changes there is no copy.
lasting = copy.deepcopy({"tree": bough.read_tree("birch.json")})["tree"].masses
gc.collect()
assert np.array_equal(lasting, tree.masses) and copy.copy(tree) is tree
for unlike in (again, bough.Scene(), tree):
    for way in (pickle.dumps,) if unlike is tree else (copy.copy, copy.deepcopy, pickle.dumps):
        try:
            way(unlike)
            raise AssertionError(f"{way} takes a {type(unlike).__name__}")
        except TypeError as error:
            assert "is neither copied nor pickled" in str(error), error
for thing, name in (again, "wind"), (again, "gravity"), (bough.Scene(), "wind"):
    try:
        setattr(thing, name, "storm")
        raise AssertionError(f"{name} = is taken")
    except AttributeError as error:
        assert f"{name} is changed by set_{name}()" in str(error), error
raises(bough.UsageError, "material: is 5, expected a name", lambda: bough.convert(bough.grow("palm", bodies=50), material=5))
raises(bough.UsageError, "file: is bytes, expected a file's name", lambda: bough.read_scene(b"{}"))
raises(bough.UsageError, "source: is int, expected a file's name, bytes", lambda: bough.read_tree(5))
raises(bough.UsageError, "its read() gives NoneType", lambda: bough.read_tree(types.SimpleNamespace(read=lambda: None)))
raises(bough.InputError, "null byte", lambda: bough.read_tree("a\0b"))
raises(bough.OutputError, "none/tree.safetensors: No such file", lambda: tree.save("none/tree.safetensors"))
with tempfile.TemporaryFile() as file:  # whose name is a number
    file.write(tree.to_bytes())
    file.seek(0)
    assert len(bough.read_tree(file)) == len(tree)
raises(bough.UsageError, "direction is 0", lambda: of(tree).pick([0, 0, 0], [0, 0, 0]))
raises(bough.UsageError, "began without one", lambda: of(tree, wind=None).set_wind("gusty"))
run = of(tree, pulls=True)
for _ in range(3):
    run.pull(20, [0, 0, 0.1], [1e308, 1e308, 0])
def until_broken():
    for _ in range(5):
        run.step()
raises(bough.NonFiniteError, "became non-finite in step", until_broken)
raises(bough.NonFiniteError, "became non-finite in step", run.save)
assert isinstance(bough.UsageError("x"), ValueError)

# Each name that is public says what it is.
for name in bough.__all__[:-1]:
    thing = getattr(bough, name)
    assert thing.__doc__, name
    for key, value in vars(thing).items() if isinstance(thing, type) else ():
        if not key.startswith("_") and (callable(value) or isinstance(value, property)) and key not in ("velocity",):
            assert value.__doc__, f"{name}.{key}"
