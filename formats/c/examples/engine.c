/* engine.c: three trees in another program's loop, with that program's own allocator. Builds with an installed bough, as C11:
 *     cc -O2 engine.c -o engine $(pkg-config --cflags --libs bough_c) -pthread && ./engine 1000
 * The loop draws at 60 frames a second; a tree's step is 1/30 s, so each frame steps some of the trees, and all are drawn between their last two
 * states. Prints the processor's time a frame, and how often the allocator was asked for memory. */
#include <bough/bough_c.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
/* --- The engine's allocator: blocks of powers of two from one arena, behind malloc's own names, by which bough and its C++ library call it too. */
static _Alignas(64) unsigned char arena[(size_t)1 << 30]; /* costs what is touched */
static size_t used, calls;
static void* freed[64];
static atomic_flag locked = ATOMIC_FLAG_INIT;
static void lock(void) { while (atomic_flag_test_and_set(&locked)) {} }
typedef struct { size_t kind; void* block; } Head; /* stands before what is given */
static void* take(size_t size, size_t alignment) {
    size_t kind = 6; unsigned char *block, *given;
    if (alignment < 16) alignment = 16;
    if (size > sizeof arena || alignment > sizeof arena) return NULL;
    while (((size_t)1 << kind) < size + alignment + sizeof(Head)) ++kind;
    lock(), ++calls, block = freed[kind];
    if (block) memcpy(&freed[kind], block, sizeof(void*));
    else if (used + ((size_t)1 << kind) <= sizeof arena) block = arena + used, used += (size_t)1 << kind;
    atomic_flag_clear(&locked);
    if (!block) return NULL;
    given = block + sizeof(Head), given += (alignment - (size_t)given % alignment) % alignment;
    ((Head*)given)[-1] = (Head){kind, block};
    return given;
}
void* malloc(size_t size) { return take(size, 16); }
void* aligned_alloc(size_t alignment, size_t size) { return take(size, alignment); }
int posix_memalign(void** to, size_t alignment, size_t size) { return (*to = take(size, alignment)) ? 0 : 12; /* ENOMEM */ }
void* calloc(size_t count, size_t size) {
    void* given = size && count > sizeof arena / size ? NULL : take(count * size, 16);
    return given ? memset(given, 0, count * size) : NULL;
}
void free(void* given) {
    if (!given) return;
    const Head head = ((Head*)given)[-1];
    lock(), memcpy(head.block, &freed[head.kind], sizeof(void*));
    freed[head.kind] = head.block, atomic_flag_clear(&locked);
}
void* realloc(void* given, size_t size) {
    void* moved = take(size, 16);
    if (!moved || !given) return moved;
    const Head head = ((Head*)given)[-1];
    const size_t had = ((size_t)1 << head.kind) - (size_t)((unsigned char*)given - (unsigned char*)head.block);
    memcpy(moved, given, had < size ? had : size), free(given);
    return moved;
}
/* --- The engine's trees. */
enum { trees = 3 };
typedef struct { float position[3], rotation[4]; } Transform; /* as a renderer's buffer has it */
typedef struct {
    bough_simulation* simulation;
    size_t bodies;
    Transform *memory, *last, *now, *drawn; /* two states, and what is between them */
    double behind;                 /* [s] how far the drawn one is from `last` toward `now` */
} Plant;
static void must(bough_result result) {
    if (result != BOUGH_OK) fprintf(stderr, "%s\n", bough_error()), exit(result);
}
static void take_state(Plant* p) {
    bough_array x, q;
    Transform* const older = p->last;
    must(bough_read(p->simulation, BOUGH_POSITION, &x)), must(bough_read(p->simulation, BOUGH_ROTATION, &q));
    p->last = p->now, p->now = older;
    for (size_t i = 0; i < p->bodies; ++i) {
        float *const r = p->now[i].rotation, *const before = p->last[i].rotation;
        float dot = 0;
        for (int k = 0; k < 3; ++k) p->now[i].position[k] = (float)x.data[3 * i + k];
        for (int k = 0; k < 4; ++k) r[k] = (float)q.data[4 * i + k], dot += r[k] * before[k];
        for (int k = 0; k < 4; ++k) r[k] = dot < 0 ? -r[k] : r[k]; /* q and -q are one rotation: between them is none */
    }
}
static void plant(Plant* p, const char* species, int64_t bodies, double phase) {
    bough_growth growth = bough_default_growth();
    bough_settings settings = bough_default_settings();
    bough_splines* splines; bough_tree* tree; bough_scene* scene;
    bough_wind wind; bough_bodies all;
    growth.species = species, growth.bodies = bodies, growth.leaves = 1;
    settings.precision = BOUGH_FLOAT, settings.threads = 1; /* the engine has threads of its own: a tree each */
    must(bough_grow(&growth, &splines)), must(bough_convert(splines, NULL, &tree)), must(bough_wind_preset("breeze", &wind));
    must(bough_read_scene(NULL, 0, NULL, &scene)), must(bough_scene_set_wind(scene, &wind)), must(bough_scene_add(scene, tree, NULL, 0));
    must(bough_simulate(scene, &settings, NULL, &p->simulation)), must(bough_tree_bodies(tree, &all));
    p->bodies = all.count, p->behind = phase;
    p->last = malloc(3 * p->bodies * sizeof(Transform)), p->now = p->last + p->bodies, p->drawn = p->now + p->bodies;
    must(p->last ? BOUGH_OK : BOUGH_INPUT), p->memory = p->last;
    bough_free(splines), bough_free(tree), bough_free(scene);
    take_state(p), take_state(p);
}
int main(int argc, char** argv) {
    static const char* const species[trees] = {"apple", "birch", "willow"};
    const double step = 1 / 30., frame = 1 / 60.;
    Plant all[trees] = {0};
    double cost = 0, most = 0; size_t before = 0, bodies = 0, frames = 600;
    for (int t = 0; t < trees; ++t)
        plant(&all[t], species[t], argc > 1 ? atoll(argv[1]) : 1000, t * step / trees), bodies += all[t].bodies;
    for (size_t f = 0; f < frames + 60; ++f) { /* the first second is left out */
        const clock_t began = clock();
        if (f == 60) cost = most = 0, before = calls;
        for (int t = 0; t < trees; ++t) {
            Plant* const p = &all[t];
            for (p->behind += frame; p->behind >= step; p->behind -= step)
                must(bough_step(p->simulation, NULL)), take_state(p);
            const float share = (float)(p->behind / step);
            for (size_t i = 0; i < p->bodies; ++i)
                for (int k = 0; k < 7; ++k) /* rotations too: a step's is small; a renderer makes them of length 1 */
                    ((float*)&p->drawn[i])[k] = (1 - share) * ((float*)&p->last[i])[k] + share * ((float*)&p->now[i])[k];
        }
        const double took = (double)(clock() - began) / CLOCKS_PER_SEC;
        cost += took, most = took > most ? took : most;
    }
    printf("%zu bodies in %d trees: %.3f ms a frame, %.3f at most; %zu allocations in %zu frames, %zu MiB of arena\n", bodies, trees,
           1e3 * cost / (double)frames, 1e3 * most, calls - before, frames, used >> 20);
    for (int t = 0; t < trees; ++t) bough_free(all[t].simulation), free(all[t].memory);
    return 0;
}
