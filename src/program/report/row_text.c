/* The numbers of a row of a table as text: Fortran's formats take a third longer, and each mixture of integers, numbers
   and words needs one of its own. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* As of wavycon_memory_table. */
enum { OF_INTEGERS = 2, OF_WORDS = 3 };

/* Writes numbers to a line of blanks, each so that it ends with its column: integers, and others with 16 digits and an
   exponent of three. Columns of words stay blank. */
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
            text[signbit(*numbers) ? 2 : 1] = '.'; /* in every locale */
            char *exponent = strchr(text, 'E');
            sprintf(exponent, "E%+04d", atoi(exponent + 1));
        }
        memcpy(line + ends[k] - strlen(text), text, strlen(text));
        numbers++;
    }
}
