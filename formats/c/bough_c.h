/* bough_c.h: bough for C, and for whatever calls C: engines, Python (bough.py), C#, a page. Plain C99; link bough_files (pkg-config bough_c).
 *
 *   bough_growth apple = bough_default_growth();
 *   bough_splines *splines;  bough_tree *tree;  bough_scene *scene;  bough_simulation *simulation;
 *   apple.species = "apple"; apple.bodies = 2000;
 *   bough_grow(&apple, &splines);
 *   bough_convert(splines, NULL, &tree);
 *   bough_read_scene(NULL, 0, NULL, &scene);                      // an empty one; or the bytes of a scene document
 *   bough_scene_add(scene, tree, NULL, 0);
 *   bough_simulate(scene, NULL, NULL, &simulation);
 *   while (bough_step(simulation, NULL) == BOUGH_OK) { bough_array x; bough_read(simulation, BOUGH_POSITION, &x); ... }
 *
 * Errors. Each function that can fail gives a bough_result; what is not BOUGH_OK has left its outputs as they were (but bough_step's report), and
 * bough_error() says in one line what was wrong, where, what was expected. Nothing is thrown, printed or ended by a call.
 * Handles. bough_splines, bough_tree, bough_scene, bough_simulation are numbers, not addresses, never given twice: one that is NULL, freed, of
 * another kind or no handle at all is refused (BOUGH_USAGE). bough_free frees each; what others were made of may be freed at once. A pointer to
 * settings or outputs that is NULL is refused where it is not said to mean something; one that points nowhere cannot be told from one that does.
 * Settings. From their default function, which leaves a mark in `check`: others are refused, and so are those of another version's header.
 * Threads. Any function on any thread. One scene or simulation is used by one thread at a time: a call for one that another call is using is refused.
 * Several run side by side; trees and splines never change, and all may share them. Results do not hang on the number of threads.
 * Memory. An array's address stays as long as the simulation; what stands there changes with the first bough_read or bough_pick after a step. Events
 * are gone with the next step. What a call writes goes where the caller says. Where memory ends: BOUGH_INPUT, "out of memory".
 * A step allocates nothing once some have run, but where something breaks. There are no hooks: a program's own malloc serves bough too.
 * Units and axes. SI; world axes, y up; quaternions x, y, z, w, world from body. A body's origin is its own joint, z runs along it. Bodies stand in
 * document order, the trees' one after another, then balls, then walkers. (lib/README.md, "Conventions".) */
#ifndef BOUGH_C_H
#define BOUGH_C_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define BOUGH_ABI 3 /* of this header */
/* Returns that of the library that runs. Where it is not BOUGH_ABI, this header is not for it. */
int32_t bough_abi(void);
const char* bough_version(void); /* "0.1.0" */

/* The tools' exit codes. */
typedef enum bough_result {
    BOUGH_OK = 0,
    BOUGH_USAGE = 1,      /* the call is wrong: a handle, a number, settings, another thread */
    BOUGH_INPUT = 2,      /* a document is broken, or a scene cannot be run; memory has ended */
    BOUGH_NON_FINITE = 3, /* the simulation became non-finite */
    BOUGH_OUTPUT = 4      /* what was to be written does not fit */
} bough_result;

/* Of this thread's last call that was not BOUGH_OK; "" before the first. Valid until the next such call of this thread. */
const char* bough_error(void);

typedef struct bough_splines bough_splines;       /* a tree's branches as curves (formats/documents/README.md) */
typedef struct bough_tree bough_tree;             /* rigid bodies on joints (bough-tree) */
typedef struct bough_scene bough_scene;           /* which trees stand where, and what acts on them (bough-scene) */
typedef struct bough_simulation bough_simulation; /* one run of a scene */

bough_result bough_free(void* handle); /* of any kind; NULL: nothing */

/* --- Trees ------------------------------------------------------------------------------------------------------------------------------ */

/* As `treegen --species SPECIES --bodies BODIES --seed SEED ...`. */
typedef struct bough_growth {
    uint64_t check;                /* leave as it is */
    const char* species;           /* bough_species(); default "broadleaf" */
    int64_t bodies;                /* that bough_convert makes of it, within 10 %; 0: as many as come (default) */
    uint64_t seed;                 /* default 0 */
    double age;                    /* [years], 0.1 or more; 0: a mature tree (default) */
    int32_t leaves, petals, fruit; /* wanted where not 0 (default 0) */
} bough_growth;
bough_growth bough_default_growth(void);
const char* bough_species(size_t k); /* names, k from 0 on; NULL behind the last */

/* Up to a second or two for the largest species, whatever `bodies`. */
bough_result bough_grow(const bough_growth* growth, bough_splines** splines);

/* A bough-splines document, JSON or safetensors. `name` stands in messages before what is wrong (NULL: "<memory>"), here and below. */
bough_result bough_read_splines(const void* bytes, size_t size, const char* name, bough_splines** splines);

/* As `treeconvert --material NAME --segment-length ...`. */
typedef struct bough_conversion {
    uint64_t check;        /* leave as it is */
    const char* material;  /* preset; NULL: the splines' own (default) */
    double segment_length; /* [m] longest body, above 0; 0: by the splines (default) */
    double max_bend;       /* [rad] largest turn of the curve in one body, 0.001 or more; default 0.35 */
    int64_t max_bodies;    /* 1 or more; 0: as many as come (default) */
} bough_conversion;
bough_conversion bough_default_conversion(void);

/* conversion NULL: the defaults. O(points + bodies). */
bough_result bough_convert(const bough_splines* splines, const bough_conversion* conversion, bough_tree** tree);

/* A bough-tree document, JSON or safetensors. */
bough_result bough_read_tree(const void* bytes, size_t size, const char* name, bough_tree** tree);
/* The tree as a document in safetensors, to buffer[0..capacity); *size: how many bytes it has. Where they do not fit, BOUGH_OUTPUT with
 * *size set; with capacity 0, to ask for the size, BOUGH_OK. */
bough_result bough_write_tree(const bough_tree* tree, void* buffer, size_t capacity, size_t* size);

enum { BOUGH_BRANCH = 0, BOUGH_LEAF = 1, BOUGH_FRUIT = 2, BOUGH_PETAL = 3 }; /* bough_bodies.kind */

/* What bodies are: arrays of `count` that live as long as the tree or simulation they were asked of. */
typedef struct bough_bodies {
    size_t count;
    const int32_t* parent; /* body index, less than its own; -1: stands on the ground */
    const uint8_t* kind;
    /* [m] branch: length, radius at its base, at its tip; leaf, petal: length, width, thickness; fruit: joint to centre, radius, radius */
    const double (*size)[3];
    const double* mass;           /* [kg] */
    const double (*com)[3];       /* [m] centre of mass, body frame */
    const double (*stiffness)[3]; /* [N m/rad] bend, bend, twist; leaf: flap, sway, twist */
    const double* damping;        /* [s] stiffness-proportional */
    const int32_t* branch;        /* number of the branch of the splines that the body belongs to, or hangs on */
    const int32_t* level;         /* that branch's level, 0 for trunks */
    size_t trees;                 /* how many trees these bodies are of */
    const size_t* first_body;     /* trees + 1 entries: tree k has bodies first_body[k] to first_body[k + 1] */
} bough_bodies;
bough_result bough_tree_bodies(const bough_tree* tree, bough_bodies* bodies);

/* --- Scenes ----------------------------------------------------------------------------------------------------------------------------- */

/* A bough-scene document, JSON: all that may act on trees can stand in it. bytes NULL and size 0: an empty scene, gravity and no more.
 * The document names trees by files, which are not opened: bough_scene_file says which, bough_scene_put gives them. */
bough_result bough_read_scene(const void* bytes, size_t size, const char* name, bough_scene** scene);

/* The file that the document names for place k (from 0 on), as written there; "" for a tree from bough_scene_add; NULL behind the last place, and for
 * what is no scene. Valid until a place is added. */
const char* bough_scene_file(const bough_scene* scene, size_t k);
/* Puts a tree in place k; where the document changes the trees' material, O(bodies). */
bough_result bough_scene_put(bough_scene* scene, size_t k, const bough_tree* tree);
/* One more place: position [m] on the ground, NULL: the origin; turned by yaw [deg] about +y. */
bough_result bough_scene_add(bough_scene* scene, const bough_tree* tree, const double position[3], double yaw);

/* The fields of a scene's "wind" that may change in a run. */
typedef struct bough_wind {
    uint64_t check;          /* leave as it is */
    double velocity[3];      /* [m/s] mean at the reference height, blowing toward */
    double reference_height; /* [m] above 0 */
    double profile;          /* exponent over height; 0: uniform */
    double turbulence;       /* standard deviation along the wind over the mean, 0 or more */
    double gust_factor;      /* peak over mean, 1 or more; 1: no gusts */
    double gust_period;      /* [s] above 0 */
    uint64_t seed;           /* of the turbulence */
} bough_wind;
/* "calm", "breeze", "gusty", "storm"; NULL: air that stands still, from which wind may rise. */
bough_result bough_wind_preset(const char* name, bough_wind* wind);
/* wind NULL: none, not even the air's drag. A wind of the document keeps what bough_wind has no field for. */
bough_result bough_scene_set_wind(bough_scene* scene, const bough_wind* wind);

/* --- Simulations ------------------------------------------------------------------------------------------------------------------------ */

enum { BOUGH_FLOAT = 0, BOUGH_DOUBLE = 1 };     /* bough_settings.precision */
enum { BOUGH_COUPLED = 0, BOUGH_ANALYTIC = 1 }; /* bough_settings.method */

typedef struct bough_settings {
    uint64_t check;     /* leave as it is */
    double step;        /* [s] above 0, of one bough_step; default 1/30 */
    int32_t precision;  /* default BOUGH_DOUBLE; float is twice as fast, arrays are doubles with both */
    int32_t method;     /* default BOUGH_COUPLED; the other is the paper's own */
    double sleep;       /* [rad/s] slower than this for a while, trees are left out of steps; 0: never (default) */
    int32_t threads;    /* of a step at most; 0: as many as the process has cores (default); small work takes fewer */
    int32_t velocities; /* BOUGH_VELOCITY and BOUGH_ANGULAR_VELOCITY are wanted; default 0, as those below */
    int32_t torques;    /* BOUGH_TORQUE is wanted */
    int32_t stresses;   /* BOUGH_STRESS is wanted */
    int32_t pulls;      /* bough_pull will be called */
    int32_t grounds;    /* bough_set_ground will be called; nothing sleeps then */
    int32_t portable;   /* one number at a time, the same on every machine; several times slower */
} bough_settings;
bough_settings bough_default_settings(void);

/* Begins a run of the scene, which may then change or go. settings NULL: the defaults. before NULL, or another run: each tree that is connected
 * as the tree of the same number was goes on with its motion, for what cannot change in a run. O(bodies). BOUGH_INPUT for a scene that cannot be run. */
bough_result bough_simulate(const bough_scene* scene, const bough_settings* settings, const bough_simulation* before,
                            bough_simulation** simulation);

typedef struct bough_report {
    int64_t steps;                /* taken */
    double time;                  /* [s] */
    uint64_t fast_turns;          /* bodies that in this step turned by more than a radian */
    uint64_t guarded;             /* were kept from gaining energy */
    uint64_t limited;             /* ended at a joint's limit */
    uint64_t broke, hits, landed; /* bough_read_events has them */
} bough_report;
/* Takes one step, from now to now + step. report may be NULL. BOUGH_NON_FINITE: the message names stage and body. All further steps then say the same
 * and change nothing. */
bough_result bough_step(bough_simulation* simulation, bough_report* report);
/* Lets the wind blow for so many seconds before time 0. It is called before the first step. What shows is then the tree's own sway, not how a tree at
 * rest takes the first blow. Balls, walkers and what may break wait for time 0. BOUGH_USAGE after a step, and for more than 600 s. */
bough_result bough_settle(bough_simulation* simulation, double seconds);
/* Gives how many seconds that takes until the start is forgotten: 2 to 20, and 0 where no wind blows. */
bough_result bough_settling_time(bough_simulation* simulation, double* seconds);
/* Gives the time of the present state, in seconds. */
bough_result bough_time(const bough_simulation* simulation, double* seconds);

typedef enum bough_field {
    BOUGH_POSITION = 0,         /* [m] of own joints (balls: centres), 3 */
    BOUGH_ROTATION = 1,         /* world from body, x y z w, 4 */
    BOUGH_VELOCITY = 2,         /* [m/s] of centres of mass, 3 (settings.velocities) */
    BOUGH_ANGULAR_VELOCITY = 3, /* [rad/s] 3 (settings.velocities) */
    BOUGH_ANGLE = 4,            /* [rad] rotation vectors of joints, joint frames, 3; of trees' bodies alone */
    BOUGH_RATE = 5,             /* [rad/s] how those change, 3 */
    BOUGH_TORQUE = 6,           /* [N m] of springs and dampers, joint frames, 3 (settings.torques); as BOUGH_ANGLE */
    BOUGH_STRESS = 7,           /* [Pa] that bends the wood at joints, 1 (settings.stresses); 0 of all but branches */
    BOUGH_FIELD_WIDTH = 0x7fffffff /* no field: the type is as wide as an int */
} bough_field;
typedef struct bough_array {
    const double* data; /* see "Memory" */
    size_t count;       /* of bodies */
    size_t components;  /* numbers of one body, side by side */
    size_t stride;      /* [bytes] from one body's to the next one's */
} bough_array;
/* The present state. The first call after a step O(bodies), for all fields together; further ones nothing. */
bough_result bough_read(bough_simulation* simulation, bough_field field, bough_array* array);

enum { BOUGH_BROKE = 0, BOUGH_HIT = 1, BOUGH_LANDED = 2, BOUGH_LEAPT = 3 }; /* bough_events.what */
/* Of the last step; arrays of `count`. */
typedef struct bough_events {
    size_t count;
    const int32_t* what;
    const int32_t* body;
    const int32_t* on;   /* what it hit, landed on or leapt from; -1: the ground, or nothing */
    const double* value; /* broke: [N m] torque; hit: [N s] impulse; landed, leapt: [m/s] speed */
} bough_events;
bough_result bough_read_events(bough_simulation* simulation, bough_events* events);

/* Bodies whose joints broke since the start, in that order; they and what they bear keep their numbers. Valid until the next step. */
bough_result bough_read_broken(bough_simulation* simulation, const uint32_t** bodies, size_t* count);

/* What a scene's document throws or sends at the trees: arrays of `count` that live as long as the simulation. */
typedef struct bough_balls {
    size_t count;         /* balls, then walkers as the balls that they are shown as */
    size_t first;         /* the first one's number in BOUGH_POSITION, where all are behind the trees' bodies */
    const double* radius; /* [m] */
    const double* mass;   /* [kg] */
} bough_balls;
bough_result bough_simulation_balls(bough_simulation* simulation, bough_balls* balls);

/* The trees' bodies, joined; without balls and walkers. */
bough_result bough_simulation_bodies(const bough_simulation* simulation, bough_bodies* bodies);

typedef struct bough_hit {
    size_t body;
    double point[3]; /* [m] body frame, as bough_pull takes it */
    double world[3]; /* [m] */
    double distance; /* [m] from the ray's start */
} bough_hit;
/* The first of the trees' bodies that the ray from `from` [m] along `direction` (any length but 0) meets. Where it meets none, the one whose axis is
 * least off it, up to aperture [rad], 0 to pi / 2. *found: 1, or 0 with *hit as it was. O(bodies). */
bough_result bough_pick(bough_simulation* simulation, const double from[3], const double direction[3], double aperture,
                        bough_hit* hit, int32_t* found);

/* A force [N] of the world on a point [m] of a body of the trees, in the next step alone. Any number of them; needs settings.pulls. */
bough_result bough_pull(bough_simulation* simulation, size_t body, const double point[3], const double force[3]);
/* A hand, a rope, a prop: a spring [N/m] and a damper [N s/m] between a point [m, body frame] of any body of the trees and a target in the world, which is
 * where the point is now; from the next step on, until it is released or the body breaks off. Any stiffness holds. (In single
 * precision a stem that a spring presses along itself with 10^5 N may go on moving.) Nothing has to be asked for beforehand.
 * *attachment: its number, above 0, which this simulation never gives twice; others count for themselves. O(bodies), which allocates; steps do not. Part of
 * no saved state. Coupled method. */
bough_result bough_attach(bough_simulation* simulation, size_t body, const double point[3], double stiffness,
                          double damping, uint64_t* attachment);
/* Its target goes evenly from where it is to `target` [m, world] in the next `steps` steps (1: the next one ends with it there), and stays; 0: is there
 * at once. To be called before each step for a hand that moves. */
bough_result bough_move_attachment(bough_simulation* simulation, uint64_t attachment, const double target[3],
                                   int32_t steps);
/* [N] on the body, world, at the last step's end. */
bough_result bough_attachment_force(bough_simulation* simulation, uint64_t attachment, double force[3]);
bough_result bough_release(bough_simulation* simulation, uint64_t attachment);
/* From the next step on. The scene began with a wind (of air that stood still, at least); reference height and profile stay as they were. */
bough_result bough_set_wind(bough_simulation* simulation, const bough_wind* wind);
/* [m/s^2] Of a scene that began with some; coupled method. */
bough_result bough_set_gravity(bough_simulation* simulation, const double gravity[3]);
/* All joints' stiffness (above 0) and damping (0 or more) over what they had when the run began; coupled method, nothing thrown at the trees. Springs keep
 * their rest, so softer wood sags further and stiffer wood rises. To keep the pose as drawn, begin a run of a scene whose document has the stiffness_scale
 * that is wanted, with this one as `before` (bough_simulate). */
bough_result bough_set_wood(bough_simulation* simulation, double stiffness, double damping);

/* [s] Above 0: of the steps from here on; the time goes on from what it is. Before the first step as if it had begun so. Coupled method. */
bough_result bough_set_step(bough_simulation* simulation, double step);

/* How a tree's ground has moved from where the tree was drawn, about the tree's own place. */
typedef struct bough_ground {
    uint64_t check;             /* leave as it is */
    double position[3];         /* [m] by which its place has moved */
    double rotation[4];         /* x y z w, world from drawn */
    double velocity[3];         /* [m/s] of the place, world */
    double angular_velocity[3]; /* [rad/s] world */
} bough_ground;
bough_ground bough_default_ground(void); /* at rest where the tree was drawn */
/* The ground under tree `tree` (from 0 on), its roots with it, is there with that velocity in `steps` steps from now, on a smooth way, and then goes on as
 * it moves by then; 0: is there at once, the tree on it as it stands, unmoved. A platform, a ship, a pot in a hand: to be called before each step for one
 * that moves as it likes. Needs settings.grounds; not for a tree to which the scene's document gives keys of its own. */
bough_result bough_set_ground(bough_simulation* simulation, size_t tree, const bough_ground* ground, int32_t steps);

/* How wrong the run is for the length of its steps: the tips of its branches against those of a companion at a quarter of the step. */
typedef struct bough_step_error {
    double rms,
        worst; /* [m] over all tips and steps so far; of the one farthest off. 0.9 to 1.8 times the true error */
    double deflection; /* [m] RMS of how far the tips are from where they were drawn: what rms is to be seen against */
    int64_t steps;     /* that were compared */
    int32_t known; /* 0: the companion swings too fast for its own steps, or became non-finite: nothing can be said */
} bough_step_error;
/* on not 0: from the next step on the companion goes beside, with all that is changed meanwhile; a step then costs five. Begins anew where it goes already,
 * and after bough_restore. 0: no more. Coupled method, nothing that is free. O(bodies). */
bough_result bough_watch_error(bough_simulation* simulation, int32_t on);
/* BOUGH_USAGE where it is not watched. */
bough_result bough_read_error(const bough_simulation* simulation, bough_step_error* error);

/* The state as `treesim --save-state` writes it (safetensors); buffer, capacity, size as with bough_write_tree. BOUGH_NON_FINITE where it is not finite any
 * more. */
bough_result bough_save(const bough_simulation* simulation, void* buffer, size_t capacity, size_t* size);
/* Goes on from there, bit by bit as the run that was saved would; wind, gravity and wood are those that this run has by now. */
bough_result bough_restore(bough_simulation* simulation, const void* bytes, size_t size, const char* name);

/* The trees as they stand now, joined, to be written or run again in a scene at the origin: at rest they then stay so. Stiffness and damping are the
 * trees' own, without bough_set_wood and the scene's scales. BOUGH_USAGE where joints are held, or broke. O(bodies). */
bough_result bough_posed_tree(const bough_simulation* simulation, bough_tree** tree);

/* Which stages and arrays the scene needs, and why: what `treesim --report plan` prints, lines of UTF-8. NULL for what is no simulation. Valid until the next
 * such call for it. */
const char* bough_explain(const bough_simulation* simulation);

/* Of angles and rates, broken joints and free bodies: what `treesim --hash` prints. */
bough_result bough_hash(const bough_simulation* simulation, uint64_t* hash);

#ifdef __cplusplus
}
#endif
#endif
