// Bough.cs: bough_c.h for C#: Unity, Godot, .NET, Mono. Unity: put it into Assets, libbough_files and libbough into Assets/Plugins/x86_64, and allow unsafe
// code. C# 7.2, .NET Standard 2.0 or .NET Framework 4.5, no package. Sway.cs beside it shows it at work.
//
//     using (Tree tree = Tree.Grow("apple", 2000)) using (Scene scene = Scene.Empty()) {
//         scene.SetWind(Wind.Preset("gusty")); scene.Add(tree);
//         simulation = Simulation.Of(scene, Settings.Default());
//     }
//     simulation.Step(); Values x = simulation.Read(Field.Position);       // x[body, 0], or x.Data for a job: the library's memory, not a copy
//
// Units, axes and threads are bough_c.h's. What the library refuses is a BoughException with its message. Splines, Tree, Scene and Simulation are
// SafeHandles: Dispose() frees one at once, the garbage collector in the end, and none while a call is using it. A call makes no garbage, but where it
// gives a text, bytes or an exception. `Native` is the C interface itself, with its own names and fields, for what these classes have not.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Bough {

public enum Result { Ok, Usage, Input, NonFinite, Output }
public enum Field { Position, Rotation, Velocity, AngularVelocity, Angle, Rate, Torque, Stress }
public enum Kind : byte { Branch, Leaf, Fruit, Petal }
public enum Event { Broke, Hit, Landed, Leapt }
public enum Precision { Float, Double }
public enum Method { Coupled, Analytic }

public sealed class BoughException : Exception {
    public readonly Result Result;
    internal BoughException(Result result, string message) : base(message) { Result = result; }
}

// --- What the C interface passes: fields are called as there --------------------------------------------------------------------------------

[StructLayout(LayoutKind.Sequential)] public struct Vector {
    public double x, y, z;
    public Vector(double x, double y, double z) { this.x = x; this.y = y; this.z = z; }
}
[StructLayout(LayoutKind.Sequential)] public struct Rotation {
    public double x, y, z, w;
    // What it does to v.
    public Vector Turn(Vector v) {
        double a = 2 * (y * v.z - z * v.y), b = 2 * (z * v.x - x * v.z), c = 2 * (x * v.y - y * v.x);
        return new Vector(v.x + w * a + y * c - z * b, v.y + w * b + z * a - x * c, v.z + w * c + x * b - y * a);
    }
}
[StructLayout(LayoutKind.Sequential)] public struct Growth {
    public ulong check; // leave as it is
    public IntPtr species; // UTF-8; Tree.Grow and Splines.Grow take a string
    public long bodies;
    public ulong seed;
    public double age;
    public int leaves, petals, fruit;
    public static Growth Default() { return Native.bough_default_growth(); }
}
[StructLayout(LayoutKind.Sequential)] public struct Conversion {
    public ulong check; // leave as it is
    public IntPtr material; // UTF-8; Splines.Convert takes a string
    public double segment_length, max_bend;
    public long max_bodies;
    public static Conversion Default() { return Native.bough_default_conversion(); }
}
[StructLayout(LayoutKind.Sequential)] public struct Wind {
    public ulong check; // leave as it is
    public Vector velocity;
    public double reference_height, profile, turbulence, gust_factor, gust_period;
    public ulong seed;
    public static Wind Preset(string name) { // null: air that stands still
        Wind wind;
        Native.Must(Native.bough_wind_preset(Native.Utf8(name), out wind));
        return wind;
    }
}
[StructLayout(LayoutKind.Sequential)] public struct Settings {
    public ulong check; // leave as it is
    public double step;
    public Precision precision;
    public Method method;
    public double sleep;
    public int threads, velocities, torques, stresses, pulls, grounds, portable;
    public static Settings Default() { return Native.bough_default_settings(); }
}
[StructLayout(LayoutKind.Sequential)] public struct Report {
    public long steps;
    public double time;
    public ulong fast_turns, guarded, limited, broke, hits, landed;
}
[StructLayout(LayoutKind.Sequential)] public struct Ground {
    public ulong check; // leave as it is
    public Vector position;
    public Rotation rotation;
    public Vector velocity, angular_velocity;
    public static Ground Default() { return Native.bough_default_ground(); }
}
[StructLayout(LayoutKind.Sequential)] public struct StepError {
    public double rms, worst, deflection;
    public long steps;
    public int known;
}
[StructLayout(LayoutKind.Sequential)] public struct Hit {
    public UIntPtr body;
    public Vector point, world;
    public double distance;
}
[StructLayout(LayoutKind.Sequential)] public unsafe struct Bodies { // arrays of `count`, as long as the tree or simulation is not disposed of
    public UIntPtr count;
    public int* parent;
    public Kind* kind;
    public Vector* size;
    public double* mass;
    public Vector* com, stiffness;
    public double* damping;
    public int* branch, level;
    public UIntPtr trees;
    public UIntPtr* first_body;
}
[StructLayout(LayoutKind.Sequential)] public unsafe struct Events { // of the last step, until the next one
    public UIntPtr count;
    public Event* what;
    public int* body, on;
    public double* value;
}
[StructLayout(LayoutKind.Sequential)] public unsafe struct Balls {
    public UIntPtr count, first;
    public double* radius, mass;
}

// A field of all bodies, where the library has it: not copied. It stays there until the simulation is disposed of; numbers change with Read() after a step.
[StructLayout(LayoutKind.Sequential)] public unsafe struct Values {
    readonly double* data;
    readonly UIntPtr count, components, stride;
    public double* Data { get { return data; } }
    public int Count { get { return (int)count; } }
    public int Components { get { return (int)components; } }
    public double this[int body, int k] {
        get {
            if ((uint)body >= (uint)Count || (uint)k >= (uint)Components) throw new IndexOutOfRangeException();
            return ((double*)((byte*)data + body * (long)stride))[k];
        }
    }
    public Vector Vector(int body) { return new Vector(this[body, 0], this[body, 1], this[body, 2]); }
    public Rotation Rotation(int body) { return new Rotation { x = this[body, 0], y = this[body, 1], z = this[body, 2], w = this[body, 3] }; }
}

// --- Objects --------------------------------------------------------------------------------------------------------------------------------

public abstract class Handle : SafeHandle {
    protected Handle() : base(IntPtr.Zero, true) {}
    public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
    protected override bool ReleaseHandle() { return Native.bough_free(handle) == Result.Ok; }
}

public sealed unsafe class Splines : Handle {
    Splines() {}
    public static Splines Grow(string species, Growth growth) {
        Splines splines;
        fixed (byte* name = Native.Utf8(species)) {
            growth.species = (IntPtr)name;
            Native.Must(Native.bough_grow(ref growth, out splines));
        }
        return splines;
    }
    public static Splines Read(byte[] bytes, string name) {
        Splines splines;
        Native.Must(Native.bough_read_splines(bytes, Native.SizeOf(bytes), Native.Utf8(name), out splines));
        return splines;
    }
    public Tree Convert(string material, Conversion conversion) { // material null: the splines' own
        Tree tree;
        fixed (byte* name = Native.Utf8(material)) {
            conversion.material = (IntPtr)name;
            Native.Must(Native.bough_convert(this, ref conversion, out tree));
        }
        return tree;
    }
}

public sealed class Tree : Handle {
    Tree() {}
    public static Tree Grow(string species, long bodies, ulong seed = 0, bool leaves = false) {
        Growth growth = Growth.Default();
        growth.bodies = bodies;
        growth.seed = seed;
        growth.leaves = leaves ? 1 : 0;
        using (Splines splines = Splines.Grow(species, growth)) return splines.Convert(null, Conversion.Default());
    }
    public static Tree Read(byte[] bytes, string name) {
        Tree tree;
        Native.Must(Native.bough_read_tree(bytes, Native.SizeOf(bytes), Native.Utf8(name), out tree));
        return tree;
    }
    public byte[] Write() { return Native.Written((byte[] to, UIntPtr capacity, out UIntPtr size) => Native.bough_write_tree(this, to, capacity, out size)); }
    public Bodies Bodies() {
        Bodies bodies;
        Native.Must(Native.bough_tree_bodies(this, out bodies));
        return bodies;
    }
}

public sealed class Scene : Handle {
    Scene() {}
    public static Scene Empty() { return Read(null, null); }
    public static Scene Read(byte[] document, string name) {
        Scene scene;
        Native.Must(Native.bough_read_scene(document, Native.SizeOf(document), Native.Utf8(name), out scene));
        return scene;
    }
    public string File(int place) { return Native.Text(Native.bough_scene_file(this, (UIntPtr)(uint)place)); } // null behind the last
    public void Put(int place, Tree tree) { Native.Must(Native.bough_scene_put(this, (UIntPtr)(uint)place, tree)); }
    public void Add(Tree tree) { Add(tree, new Vector(), 0); }
    public void Add(Tree tree, Vector position, double yaw) { Native.Must(Native.bough_scene_add(this, tree, ref position, yaw)); }
    public void SetWind(Wind wind) { Native.Must(Native.bough_scene_set_wind(this, ref wind)); }
}

public sealed unsafe class Simulation : Handle {
    Simulation() {}
    public static Simulation Of(Scene scene, Settings settings) {
        Simulation made;
        Native.Must(Native.bough_simulate(scene, ref settings, IntPtr.Zero, out made));
        return made;
    }
    public static Simulation Of(Scene scene, Settings settings, Simulation before) { // whose motion goes on
        Simulation made;
        Native.Must(Native.bough_simulate(scene, ref settings, before, out made));
        return made;
    }
    public double Settle() { // until the start is forgotten; the seconds
        double seconds;
        Native.Must(Native.bough_settling_time(this, out seconds));
        Native.Must(Native.bough_settle(this, seconds));
        return seconds;
    }
    public Report Step() {
        Report report;
        Native.Must(Native.bough_step(this, out report));
        return report;
    }
    public double Time { get { double seconds; Native.Must(Native.bough_time(this, out seconds)); return seconds; } }
    public ulong Hash { get { ulong hash; Native.Must(Native.bough_hash(this, out hash)); return hash; } }
    public Values Read(Field field) { Values values; Native.Must(Native.bough_read(this, field, out values)); return values; }
    public Events Events() { Events events; Native.Must(Native.bough_read_events(this, out events)); return events; }
    public Bodies Bodies() { Bodies bodies; Native.Must(Native.bough_simulation_bodies(this, out bodies)); return bodies; }
    public Balls Balls() { Balls balls; Native.Must(Native.bough_simulation_balls(this, out balls)); return balls; }
    public uint[] Broken() {
        uint* bodies;
        UIntPtr count;
        Native.Must(Native.bough_read_broken(this, out bodies, out count));
        uint[] all = new uint[(int)count];
        for (int k = 0; k < all.Length; ++k) all[k] = bodies[k];
        return all;
    }
    public bool Pick(Vector from, Vector direction, double aperture, out Hit hit) {
        int found;
        hit = new Hit();
        Native.Must(Native.bough_pick(this, ref from, ref direction, aperture, ref hit, out found));
        return found != 0;
    }
    public void Pull(int body, Vector point, Vector force) { Native.Must(Native.bough_pull(this, (UIntPtr)(uint)body, ref point, ref force)); }
    public ulong Attach(int body, Vector point, double stiffness, double damping) {
        ulong attachment;
        Native.Must(Native.bough_attach(this, (UIntPtr)(uint)body, ref point, stiffness, damping, out attachment));
        return attachment;
    }
    public void Move(ulong attachment, Vector target, int steps) { Native.Must(Native.bough_move_attachment(this, attachment, ref target, steps)); }
    public Vector Force(ulong attachment) { Vector force; Native.Must(Native.bough_attachment_force(this, attachment, out force)); return force; }
    public void Release(ulong attachment) { Native.Must(Native.bough_release(this, attachment)); }
    public void SetWind(Wind wind) { Native.Must(Native.bough_set_wind(this, ref wind)); }
    public void SetGravity(Vector gravity) { Native.Must(Native.bough_set_gravity(this, ref gravity)); }
    public void SetWood(double stiffness, double damping) { Native.Must(Native.bough_set_wood(this, stiffness, damping)); }
    public void SetStep(double seconds) { Native.Must(Native.bough_set_step(this, seconds)); }
    public void SetGround(int tree, Ground ground, int steps) { Native.Must(Native.bough_set_ground(this, (UIntPtr)(uint)tree, ref ground, steps)); }
    public void WatchError(bool on) { Native.Must(Native.bough_watch_error(this, on ? 1 : 0)); }
    public StepError Error { get { StepError error; Native.Must(Native.bough_read_error(this, out error)); return error; } }
    public byte[] Save() { return Native.Written((byte[] to, UIntPtr capacity, out UIntPtr size) => Native.bough_save(this, to, capacity, out size)); }
    public void Restore(byte[] state, string name) { Native.Must(Native.bough_restore(this, state, Native.SizeOf(state), Native.Utf8(name))); }
    public Tree PosedTree() { Tree tree; Native.Must(Native.bough_posed_tree(this, out tree)); return tree; }
    public string Explain() {
        string text = Native.Text(Native.bough_explain(this));
        if (text == null) Native.Must(Result.Usage);
        return text;
    }
}

// --- The C interface ------------------------------------------------------------------------------------------------------------------------

// Texts are bytes of UTF-8 with a 0 at their end: `string` would be Latin letters of the machine's own on some platforms. size_t is UIntPtr, an enum an int.
public static unsafe class Native {
    const int abi = 3; // BOUGH_ABI
    const string library = "bough_files";
    const CallingConvention c = CallingConvention.Cdecl;

    static Native() {
        if (bough_abi() != abi) throw new DllNotFoundException("bough: the library's interface is of version " + bough_abi() + ", Bough.cs of " + abi);
    }

    public static void Must(Result result) { // on the thread of the call: messages are a thread's own
        if (result != Result.Ok) throw new BoughException(result, Text(bough_error()));
    }
    public static byte[] Utf8(string text) { return text == null ? null : Encoding.UTF8.GetBytes(text + "\0"); }
    public static string Text(IntPtr utf8) {
        if (utf8 == IntPtr.Zero) return null;
        int length = 0;
        while (((byte*)utf8)[length] != 0) ++length;
        return length == 0 ? "" : Encoding.UTF8.GetString((byte*)utf8, length);
    }
    public static UIntPtr SizeOf(byte[] bytes) { return bytes == null ? UIntPtr.Zero : (UIntPtr)(uint)bytes.Length; }
    public delegate Result Write(byte[] to, UIntPtr capacity, out UIntPtr size);
    public static byte[] Written(Write write) {
        UIntPtr size;
        Must(write(null, UIntPtr.Zero, out size));
        byte[] bytes = new byte[(int)size];
        Must(write(bytes, size, out size));
        return bytes;
    }

    [DllImport(library, CallingConvention = c)] public static extern int bough_abi();
    [DllImport(library, CallingConvention = c)] public static extern IntPtr bough_version();
    [DllImport(library, CallingConvention = c)] public static extern IntPtr bough_error();
    [DllImport(library, CallingConvention = c)] public static extern Result bough_free(IntPtr handle);
    [DllImport(library, CallingConvention = c)] public static extern Growth bough_default_growth();
    [DllImport(library, CallingConvention = c)] public static extern IntPtr bough_species(UIntPtr k);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_grow(ref Growth growth, out Splines splines);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_read_splines(byte[] bytes, UIntPtr size, byte[] name, out Splines splines);
    [DllImport(library, CallingConvention = c)] public static extern Conversion bough_default_conversion();
    [DllImport(library, CallingConvention = c)] public static extern Result bough_convert(Splines splines, ref Conversion conversion, out Tree tree);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_read_tree(byte[] bytes, UIntPtr size, byte[] name, out Tree tree);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_write_tree(Tree tree, byte[] buffer, UIntPtr capacity, out UIntPtr size);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_tree_bodies(Tree tree, out Bodies bodies);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_read_scene(byte[] bytes, UIntPtr size, byte[] name, out Scene scene);
    [DllImport(library, CallingConvention = c)] public static extern IntPtr bough_scene_file(Scene scene, UIntPtr k);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_scene_put(Scene scene, UIntPtr k, Tree tree);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_scene_add(Scene scene, Tree tree, ref Vector position, double yaw);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_wind_preset(byte[] name, out Wind wind);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_scene_set_wind(Scene scene, ref Wind wind);
    [DllImport(library, CallingConvention = c)] public static extern Settings bough_default_settings();
    [DllImport(library, CallingConvention = c)] public static extern Result bough_simulate(Scene scene, ref Settings settings, IntPtr before, out Simulation simulation);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_simulate(Scene scene, ref Settings settings, Simulation before, out Simulation simulation);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_step(Simulation simulation, out Report report);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_settle(Simulation simulation, double seconds);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_settling_time(Simulation simulation, out double seconds);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_time(Simulation simulation, out double seconds);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_read(Simulation simulation, Field field, out Values values);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_read_events(Simulation simulation, out Events events);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_read_broken(Simulation simulation, out uint* bodies, out UIntPtr count);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_simulation_balls(Simulation simulation, out Balls balls);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_simulation_bodies(Simulation simulation, out Bodies bodies);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_pick(Simulation simulation, ref Vector from, ref Vector direction, double aperture, ref Hit hit, out int found);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_pull(Simulation simulation, UIntPtr body, ref Vector point, ref Vector force);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_attach(Simulation simulation, UIntPtr body, ref Vector point, double stiffness, double damping, out ulong attachment);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_move_attachment(Simulation simulation, ulong attachment, ref Vector target, int steps);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_attachment_force(Simulation simulation, ulong attachment, out Vector force);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_release(Simulation simulation, ulong attachment);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_set_wind(Simulation simulation, ref Wind wind);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_set_gravity(Simulation simulation, ref Vector gravity);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_set_wood(Simulation simulation, double stiffness, double damping);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_set_step(Simulation simulation, double step);
    [DllImport(library, CallingConvention = c)] public static extern Ground bough_default_ground();
    [DllImport(library, CallingConvention = c)] public static extern Result bough_set_ground(Simulation simulation, UIntPtr tree, ref Ground ground, int steps);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_watch_error(Simulation simulation, int on);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_read_error(Simulation simulation, out StepError error);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_save(Simulation simulation, byte[] buffer, UIntPtr capacity, out UIntPtr size);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_restore(Simulation simulation, byte[] bytes, UIntPtr size, byte[] name);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_posed_tree(Simulation simulation, out Tree tree);
    [DllImport(library, CallingConvention = c)] public static extern IntPtr bough_explain(Simulation simulation);
    [DllImport(library, CallingConvention = c)] public static extern Result bough_hash(Simulation simulation, out ulong hash);
}

} // namespace Bough
