/* Writes a line. */
#include "output.h"

static const char LINE[] = "I am a swarm of robots.\n";

int main(void) {
    for (const char *at = LINE; *at; at++) OUTPUT = *at;
    return 0;
}
