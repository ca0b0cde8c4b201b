/* Writes the CRC-32 of "123456789" in hexadecimal digits: CBF43926. */
#include "output.h"

static const char TEXT[] = "123456789";

int main(void) {
    unsigned crc = ~0u;
    for (const char *at = TEXT; *at; at++) {
        crc ^= (unsigned char)*at;
        for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    crc = ~crc;
    for (int shift = 28; shift >= 0; shift -= 4) {
        unsigned digit = crc >> shift & 15;
        OUTPUT = digit < 10 ? '0' + digit : 'A' + digit - 10;
    }
    return 0;
}
