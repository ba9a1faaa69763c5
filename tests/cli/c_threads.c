/* c_threads: 100 simulations on 100 threads of their own, each of a tree of its own, made through bough_c.h from the bytes of one document; all at
 * once. Prints the hash where all have the same, else the first two that differ. Arguments: the tree's document, steps. */
#include <bough/bough_c.h>
#include <inttypes.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

enum { threads = 100 };
static char* bytes;
static size_t size;
static int steps;
static uint64_t hashes[threads];

static void* run(void* which) {
    bough_tree* tree = NULL;
    bough_scene* scene = NULL;
    bough_simulation* simulation = NULL;
    bough_wind wind;
    bough_array x;
    bough_settings settings = bough_default_settings();
    int k, bad;
    settings.precision = BOUGH_FLOAT;
    bad = bough_read_tree(bytes, size, "tree", &tree) || bough_read_scene(NULL, 0, NULL, &scene) ||
          bough_wind_preset("gusty", &wind) || bough_scene_set_wind(scene, &wind) ||
          bough_scene_add(scene, tree, NULL, 0) || bough_simulate(scene, &settings, NULL, &simulation);
    bough_free(tree);
    bough_free(scene);
    for (k = 0; k < steps && !bad; ++k)
        bad = bough_step(simulation, NULL) || bough_read(simulation, BOUGH_POSITION, &x);
    if (bad || bough_hash(simulation, &hashes[(uint64_t*)which - hashes])) {
        fprintf(stderr, "%s\n", bough_error());
        exit(1);
    }
    bough_free(simulation);
    return NULL;
}

int main(int argc, char** argv) {
    pthread_t thread[threads];
    FILE* file = argc == 3 ? fopen(argv[1], "rb") : NULL;
    int t;
    if (!file) return 1;
    fseek(file, 0, SEEK_END);
    size = (size_t)ftell(file);
    rewind(file);
    bytes = malloc(size);
    if (!bytes || fread(bytes, 1, size, file) != size) return 1;
    fclose(file);
    steps = atoi(argv[2]);
    for (t = 0; t < threads; ++t)
        if (pthread_create(&thread[t], NULL, run, &hashes[t]) != 0) return 1;
    for (t = 0; t < threads; ++t) pthread_join(thread[t], NULL);
    for (t = 1; t < threads; ++t)
        if (hashes[t] != hashes[0]) {
            printf("thread %d has %016" PRIx64 ", thread 0 %016" PRIx64 "\n", t, hashes[t], hashes[0]);
            return 1;
        }
    printf("hash %016" PRIx64 "\n", hashes[0]);
    free(bytes);
    return 0;
}
