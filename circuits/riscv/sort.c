/* Sorts numbers by insertion, and writes them. */
#include "output.h"

static signed char numbers[] = {31, -4, 15, 92, -65, 35, 89, -7, 93, 2};

enum { COUNT = sizeof numbers };

static void write_number(int number) {
    if (number < 0) {
        OUTPUT = '-';
        number = -number;
    }
    int tens = 0;
    for (; number >= 10; number -= 10) tens++;
    if (tens) OUTPUT = '0' + tens;
    OUTPUT = '0' + number;
    OUTPUT = ' ';
}

int main(void) {
    for (int i = 1; i < COUNT; i++) {
        signed char moved = numbers[i];
        int at = i;
        for (; at > 0 && numbers[at - 1] > moved; at--) numbers[at] = numbers[at - 1];
        numbers[at] = moved;
    }
    for (int i = 0; i < COUNT; i++) write_number(numbers[i]);
    return 0;
}
