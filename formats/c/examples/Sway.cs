// Sway.cs: an apple tree in gusts, in a loop that draws 60 frames a second while bough steps 30 times. Bough.cs has the declarations.
//     mcs -unsafe -out:sway.exe Bough.cs Sway.cs && LD_LIBRARY_PATH=PREFIX/lib mono sway.exe 1000 600
// Prints where the highest tip stands, the motion's hash (that of `treesim --report hash`), and what a frame costs.
using System;
using System.Diagnostics;
using Bough;

// A tree that is stepped at a fixed rate, whatever the frames' is, and drawn between its last two states.
sealed class Plant : IDisposable {
    public readonly Simulation Simulation;
    public readonly int Count;
    public long Steps;
    readonly double step;
    double behind;     // [s] how far what is drawn is from `last` toward `now`
    float[] last, now; // 7 numbers a body: place, turn
    readonly float[] drawn;

    public Plant(Simulation simulation, double step) {
        Simulation = simulation;
        this.step = step;
        Count = simulation.Read(Field.Position).Count;
        last = new float[7 * Count];
        now = new float[7 * Count];
        drawn = new float[7 * Count];
        Take();
        Take();
    }
    public float[] Frame(double seconds) {
        for (behind += Math.Min(seconds, 0.25); behind >= step; behind -= step) { // who was away for longer does not catch up
            Steps = Simulation.Step().steps;
            Take();
        }
        float share = (float)(behind / step);
        for (int i = 0; i < drawn.Length; ++i) drawn[i] = (1 - share) * last[i] + share * now[i]; // turns too: a renderer makes them of length 1
        return drawn;
    }
    unsafe void Take() {
        float[] older = last;
        last = now;
        now = older;
        double* x = Simulation.Read(Field.Position).Data, q = Simulation.Read(Field.Rotation).Data; // the library's memory: three and four numbers a body
        for (int i = 0; i < Count; ++i) {
            float dot = 0;
            for (int k = 0; k < 4; ++k) dot += (float)q[4 * i + k] * last[7 * i + 3 + k];
            for (int k = 0; k < 3; ++k) now[7 * i + k] = (float)x[3 * i + k];
            for (int k = 0; k < 4; ++k) now[7 * i + 3 + k] = (float)(dot < 0 ? -q[4 * i + k] : q[4 * i + k]); // q and -q are one turn: between them is none
        }
    }
    public void Dispose() { Simulation.Dispose(); }
}

static class Sway {
    static Plant Planted(long bodies) {
        Settings settings = Settings.Default();
        settings.precision = Precision.Float;
        settings.threads = 1; // of the engine's job
        using (Tree tree = Tree.Grow("apple", bodies, 7))
        using (Scene scene = Scene.Empty()) {
            scene.SetWind(Wind.Preset("gusty"));
            scene.Add(tree);
            return new Plant(Simulation.Of(scene, settings), settings.step); // which keeps what it needs
        }
    }
    static unsafe Vector HighestTip(Simulation simulation) {
        Values x = simulation.Read(Field.Position), q = simulation.Read(Field.Rotation);
        Bodies all = simulation.Bodies();
        Vector highest = new Vector(0, double.NegativeInfinity, 0);
        for (int i = 0; i < (int)all.count; ++i) {
            Vector joint = x.Vector(i), along = q.Rotation(i).Turn(new Vector(0, 0, all.size[i].x)); // a body runs along its z
            if (joint.y + along.y > highest.y) highest = new Vector(joint.x + along.x, joint.y + along.y, joint.z + along.z);
        }
        return highest;
    }
    static int Main(string[] arguments) {
        try {
            int frames = arguments.Length > 1 ? int.Parse(arguments[1]) : 600;
            using (Plant plant = Planted(arguments.Length > 0 ? long.Parse(arguments[0]) : 1000)) {
                for (int f = 0; f < 60; ++f) plant.Frame(1 / 60.0); // compiled, and memory found
                int collections = GC.CollectionCount(0);
                TimeSpan began = Process.GetCurrentProcess().TotalProcessorTime;
                for (int f = 60; f < frames; ++f) plant.Frame(1 / 60.0);
                double ms = (Process.GetCurrentProcess().TotalProcessorTime - began).TotalMilliseconds / Math.Max(1, frames - 60);
                Vector tip = HighestTip(plant.Simulation);
                Console.WriteLine(FormattableString.Invariant($"{plant.Count} bodies, {plant.Steps} steps, tip {tip.x:R} {tip.y:R} {tip.z:R}, hash {plant.Simulation.Hash:x16}"));
                Console.Error.WriteLine(FormattableString.Invariant($"{ms:0.000} ms of the processor a frame, {GC.CollectionCount(0) - collections} garbage collections"));
            }
            return 0;
        } catch (BoughException error) {
            Console.Error.WriteLine(error.Message);
            return (int)error.Result;
        }
    }
}
