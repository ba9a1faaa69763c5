// CSharp.cs: what tests/csharp asks of formats/c/examples/Bough.cs. `declared`: prints its structs, enums and functions, as the marshaller sees them, for
// csharp.py to hold against bough_c.h. `used`: calls it rightly and wrongly, and says what is not as it should be.
using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Text.RegularExpressions;
using System.Threading;
using Bough;

static class CSharp {
    static string Snake(string name) { return Regex.Replace(name, "(?<=[a-z])(?=[A-Z])", "_").ToLowerInvariant(); }

    // The kind of a C type that a value is passed as.
    static string Passed(Type type) {
        if (type.IsByRef || type.IsPointer || type.IsArray || type == typeof(IntPtr) || typeof(SafeHandle).IsAssignableFrom(type)) return "pointer";
        if (type.IsEnum) return Passed(Enum.GetUnderlyingType(type));
        if (type == typeof(UIntPtr)) return "size_t";
        if (type == typeof(int)) return "int32_t";
        if (type == typeof(long)) return "int64_t";
        if (type == typeof(ulong)) return "uint64_t";
        if (type == typeof(double)) return "double";
        return "bough_" + Snake(type.Name);
    }
    static void Declared() {
        foreach (Type type in typeof(Native).Assembly.GetTypes().Where(one => one.Namespace == "Bough")) {
            if (type.IsEnum)
                foreach (object value in Enum.GetValues(type)) Console.WriteLine($"enum BOUGH_{Snake(value.ToString()).ToUpperInvariant()} {System.Convert.ToInt64(value)}");
            else if (type.IsValueType) {
                string name = type == typeof(Values) ? "array" : Snake(type.Name);
                Console.WriteLine($"struct {name} {Marshal.SizeOf(type)}");
                foreach (FieldInfo field in type.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic))
                    Console.WriteLine($"field {name} {field.Name} {Marshal.OffsetOf(type, field.Name)}");
            }
        }
        foreach (MethodInfo method in typeof(Native).GetMethods().Where(one => one.GetCustomAttribute<DllImportAttribute>() != null))
            Console.WriteLine($"function {method.Name} {Passed(method.ReturnType)} {string.Join(" ", method.GetParameters().Select(one => Passed(one.ParameterType)))}".TrimEnd());
    }

    static int wrong;
    static void Expect(bool holds, string what) {
        if (holds) return;
        ++wrong;
        Console.WriteLine(what);
    }
    static void Refused(Result result, string text, Action call) {
        try {
            call();
            Expect(false, $"nothing was refused, expected '{text}'");
        } catch (BoughException error) {
            Expect(error.Result == result && error.Message.Contains(text), $"{error.Result}: '{error.Message}', expected {result}: '{text}'");
        }
    }
    static readonly Tree tree = Tree.Grow("birch", 300, 2, true);
    static Simulation Birch(int pulls = 0) {
        using (Scene scene = Scene.Empty()) {
            scene.Add(tree, new Vector(1, 0, 2), 30);
            scene.SetWind(Wind.Preset("gusty"));
            Settings settings = Settings.Default();
            settings.pulls = settings.grounds = pulls;
            return Simulation.Of(scene, settings);
        }
    }
    static unsafe void Used() {
        // Texts are UTF-8 on their way there and back.
        Refused(Result.Usage, "is 'Bäumchen 木 🌳', expected one of", () => Tree.Grow("Bäumchen 木 🌳", 100));
        Refused(Result.Input, "дерево.json: ", () => Tree.Read(new byte[] { 1, 2, 3 }, "дерево.json"));
        Refused(Result.Usage, "species: is NULL", () => Splines.Grow(null, Growth.Default()));
        Refused(Result.Usage, "step: is -1", () => { Settings s = Settings.Default(); s.step = -1; using (Scene scene = Scene.Empty()) Simulation.Of(scene, s); });
        Refused(Result.Usage, "settings: was not made by", () => { using (Scene scene = Scene.Empty()) Simulation.Of(scene, new Settings()); });
        Expect(Native.Text(Native.bough_species((UIntPtr)0)).Length > 0 && Native.Text(Native.bough_species((UIntPtr)10000)) == null, "species have no names");

        // Sizes, masses and places of bodies: what comes by pointer is what the documents say.
        using (Simulation run = Birch(1)) {
            Bodies all = run.Bodies();
            Values x = run.Read(Field.Position), q = run.Read(Field.Rotation);
            int count = (int)all.count;
            Expect(count > 200 && x.Count == count && x.Components == 3 && q.Components == 4 && (int)all.trees == 1 && (int)all.first_body[1] == count, "bodies are not counted alike");
            Expect(all.parent[0] == -1 && x[0, 0] == 1 && x[0, 2] == 2, $"the root is at {x[0, 0]}, {x[0, 2]}");
            for (int i = 0; i < count; ++i) {
                Rotation turn = q.Rotation(i);
                Expect(all.parent[i] < i && all.mass[i] > 0 && all.size[i].x > 0 && all.kind[i] <= Kind.Petal, $"body {i} is none");
                Expect(Math.Abs(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z + turn.w * turn.w - 1) < 1e-12, $"body {i} has no turn");
                if (i == 0 || all.kind[i] != Kind.Branch || all.branch[i] != all.branch[all.parent[i]]) continue;
                int p = all.parent[i]; // a branch goes on where the piece before ends
                Vector end = q.Rotation(p).Turn(new Vector(0, 0, all.size[p].x));
                double off = Math.Abs(x[p, 0] + end.x - x[i, 0]) + Math.Abs(x[p, 1] + end.y - x[i, 1]) + Math.Abs(x[p, 2] + end.z - x[i, 2]);
                Expect(off < 1e-9, $"body {i} is {off} m off the end of the one before");
            }
            try {
                double lost = x[count, 0];
                Expect(false, $"a body that is not there is at {lost}");
            } catch (IndexOutOfRangeException) {}

            // The same memory after a step, with other numbers in it.
            double* memory = x.Data;
            double before = x[count - 1, 0];
            Report report = run.Step();
            Expect(report.steps == 1 && Math.Abs(report.time - 1 / 30.0) < 1e-12 && run.Time == report.time, $"a step is said to be {report.steps}, {report.time} s");
            Expect(run.Read(Field.Position).Data == memory && x[count - 1, 0] != before, "positions are not read where they are");
            Refused(Result.Usage, "settings.velocities", () => run.Read(Field.Velocity));

            // A hand, a ray, a state, a plan.
            ulong hand = run.Attach(count / 2, new Vector(0, 0, 0), 1e4, 10);
            run.Move(hand, new Vector(x[count / 2, 0], x[count / 2, 1], x[count / 2, 2] + 0.05), 5);
            for (int k = 0; k < 20; ++k) run.Step();
            Vector force = run.Force(hand);
            Expect(force.z != 0 && Math.Abs(force.x) + Math.Abs(force.y) + Math.Abs(force.z) < 1e6, $"the hand pulls by {force.z} N");
            run.Release(hand);
            Refused(Result.Usage, "was released", () => run.Force(hand));
            Hit hit;
            Vector trunk = x.Vector(1);
            Expect(run.Pick(new Vector(trunk.x + 9, trunk.y, trunk.z), new Vector(-1, 0, 0), 0.05, out hit) && Math.Abs(hit.distance - 9) < 1, $"the ray meets body {hit.body} at {hit.distance} m");
            Expect(!run.Pick(new Vector(0, 900, 0), new Vector(0, 1, 0), 0, out hit), "the ray meets what is not there");
            byte[] state = run.Save();
            run.Step();
            ulong hash = run.Hash;
            run.Restore(state, "state");
            run.Step();
            Expect(run.Hash == hash, "a restored run goes on otherwise");
            Expect(run.Explain().Contains("solver coupled") && run.Broken().Length == 0 && (int)run.Balls().count == 0, "the plan is not told");
            using (Tree posed = run.PosedTree()) Expect((int)posed.Bodies().count == count && posed.Write().Length > 10000, "the tree as it stands is another");
            run.SetWood(0.9, 1);
            run.SetStep(0.02);
            Wind wind = Wind.Preset("storm");
            wind.velocity = new Vector(0, 0, 12);
            run.SetWind(wind);
            run.Pull(3, new Vector(), new Vector(0, 1, 0));
            run.WatchError(true);
            run.Step();
            Expect(run.Error.steps == 1 && run.Error.rms >= 0, "the error is not told");
            Refused(Result.Usage, "tree 7 is not there", () => { Simulation s = run; s.SetGround(7, Ground.Default(), 1); });
        }

        // What was disposed of is not called; what nobody holds is freed; a run that a call is using is refused to another thread.
        Simulation gone = Birch();
        gone.Dispose();
        gone.Dispose();
        try {
            gone.Step();
            Expect(false, "a run that was disposed of is stepped");
        } catch (ObjectDisposedException) {}
        var forgotten = new List<WeakReference>();
        for (int k = 0; k < 30; ++k) forgotten.Add(Forgotten());
        for (int k = 0; k < 20 && forgotten.Any(one => one.IsAlive); ++k) {
            GC.Collect();
            GC.WaitForPendingFinalizers();
        }
        Expect(forgotten.Count(one => one.IsAlive) < 5, $"{forgotten.Count(one => one.IsAlive)} of 30 runs are never freed"); // Mono's stack is read conservatively
        using (Simulation shared = Birch()) {
            int refused = 0, taken = 0;
            var threads = Enumerable.Range(0, 2).Select(_ => new Thread(() => {
                for (int k = 0; k < 200; ++k)
                    try {
                        shared.Step();
                        Interlocked.Increment(ref taken);
                    } catch (BoughException error) {
                        Expect(error.Result == Result.Usage && error.Message.Contains("another call is using it"), error.Message);
                        Interlocked.Increment(ref refused);
                    }
            })).ToList();
            threads.ForEach(one => one.Start());
            threads.ForEach(one => one.Join());
            Expect(taken + refused == 400 && shared.Step().steps == taken + 1, $"{taken} steps were taken, {refused} refused");
        }
    }
    static WeakReference Forgotten() {
        Simulation run = Birch();
        run.Step();
        return new WeakReference(run);
    }
    static int Main(string[] arguments) {
        if (arguments[0] == "declared") Declared();
        else Used();
        return wrong == 0 ? 0 : 1;
    }
}
