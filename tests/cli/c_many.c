/* c_many: simulations made and dropped one after another through bough_c.h, each with a scene and a wind of its own, stepped a few times, with a hand,
 * a new wind, a saved state that is taken up by a second one; every tenth is asked for what is not there. Prints what the process holds of memory
 * after a tenth of them and at the end. Exit 1 if that grew by more than 1 MB. Arguments: a tree's document, how many. */
#include <bough/bough_c.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static void check(int bad) {
    if (!bad) return;
    fprintf(stderr, "%s\n", bough_error());
    exit(1);
}

/* [bytes] of the process in memory. */
static long resident(void) {
    long all = 0, held = 0;
    FILE* file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%ld %ld", &all, &held) != 2) exit(1);
    fclose(file);
    return held * sysconf(_SC_PAGESIZE);
}

static void once(const bough_tree* tree, long k) {
    static char state[1 << 20];
    const double point[3] = {0, 0, 0};
    size_t size = 0;
    uint64_t hand = 0;
    bough_scene* scene = NULL;
    bough_simulation *run = NULL, *second = NULL;
    bough_wind wind;
    bough_settings settings = bough_default_settings();
    bough_array x;
    settings.precision = k % 2 ? BOUGH_FLOAT : BOUGH_DOUBLE;
    check(bough_read_scene(NULL, 0, NULL, &scene) || bough_wind_preset("gusty", &wind) || bough_scene_set_wind(scene, &wind) ||
          bough_scene_add(scene, tree, NULL, 0) || bough_simulate(scene, &settings, NULL, &run));
    check(bough_step(run, NULL) || bough_attach(run, 3, point, 10, 1, &hand) || bough_step(run, NULL) || bough_release(run, hand) ||
          bough_set_wind(run, &wind) || bough_step(run, NULL) || bough_read(run, BOUGH_POSITION, &x) ||
          bough_save(run, state, sizeof state, &size));
    if (k % 10 == 0) {
        bough_tree* none = NULL;
        check(!bough_read_tree("{", 1, "half", &none) || !bough_attach(run, 1u << 30, point, 1, 1, &hand) ||
              !bough_restore(run, state, size / 2, "half"));
    }
    check(bough_simulate(scene, &settings, NULL, &second) || bough_restore(second, state, size, "state") || bough_step(second, NULL));
    check(bough_free(second) || bough_free(scene) || bough_free(run));
}

int main(int argc, char** argv) {
    FILE* file = argc == 3 ? fopen(argv[1], "rb") : NULL;
    const long count = argc == 3 ? atol(argv[2]) : 0;
    long k, early = 0, late;
    bough_tree* tree = NULL;
    static char bytes[1 << 22];
    if (!file || count < 1) return 1;
    check(bough_read_tree(bytes, fread(bytes, 1, sizeof bytes, file), argv[1], &tree));
    fclose(file);
    for (k = 0; k < count; ++k) {
        once(tree, k);
        if (k == count / 10) early = resident();
    }
    late = resident();
    check(bough_free(tree));
    printf("%ld simulations, and as many restored: %ld kB after a tenth, %ld kB at the end\n", count, early / 1024, late / 1024);
    return late > early + (1 << 20);
}
