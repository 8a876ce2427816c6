/* The numbers of a row of a table as text. Fortran's formatted output takes a third longer, and it needs a format of
   its own for each mixture of integers, real numbers and words. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The kinds of columns, with the values of of_integers and of_words in wavycon_memory_table. */
enum { OF_INTEGERS = 2, OF_WORDS = 3 };

/* Writes numbers to a line of blanks. Each number ends where its column ends: ends[k] is the position behind column k.
   kinds[k] is the kind of column k. Real numbers get 16 digits and an exponent of three digits. Columns of words stay
   blank, so that `numbers` has no elements for them. */
void wavycon_put_in_columns(int columns, const int *kinds, const int *ends, const double *numbers, char *line)
{
    for (int k = 0; k < columns; k++) {
        char text[32];
        if (kinds[k] == OF_WORDS)
            continue;
        if (!isfinite(*numbers)) {
            strcpy(text, isnan(*numbers) ? "NaN" : *numbers < 0.0 ? "-Infinity" : "Infinity");
        } else if (kinds[k] == OF_INTEGERS) {
            snprintf(text, sizeof text, "%.0f", *numbers);
        } else {
            sprintf(text, "%.15E", *numbers);
            text[signbit(*numbers) ? 2 : 1] = '.'; /* a locale may write a comma */
            char *exponent = strchr(text, 'E');
            sprintf(exponent, "E%+04d", atoi(exponent + 1));
        }
        memcpy(line + ends[k] - strlen(text), text, strlen(text));
        numbers++;
    }
}
