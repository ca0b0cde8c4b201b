/* Writes the primes below 50, found with a sieve. */
#include "output.h"

enum { END = 50 };

static unsigned char is_composite[END];

int main(void) {
    for (int number = 2; number < END; number++) {
        if (is_composite[number]) continue;
        for (int multiple = number + number; multiple < END; multiple += number) is_composite[multiple] = 1;
        int tens = 0;
        int ones = number;
        for (; ones >= 10; ones -= 10) tens++;
        if (tens) OUTPUT = '0' + tens;
        OUTPUT = '0' + ones;
        OUTPUT = ' ';
    }
    return 0;
}
