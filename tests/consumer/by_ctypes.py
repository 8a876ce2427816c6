"""The C interface of the library by ctypes: errors are exceptions, tables dictionaries of columns."""
from ctypes import CDLL, byref, c_char_p, c_double, c_int, c_size_t, c_void_p, create_string_buffer

POINTER, TEXT = c_void_p, c_char_p
FUNCTIONS = {
    "new_error": (POINTER, []),
    "get_message": (c_size_t, [POINTER, POINTER, c_size_t]),
    "new_scene": (POINTER, [POINTER, TEXT, TEXT, c_int, c_int, c_int, POINTER]),
    "solve": (POINTER, [POINTER, POINTER, TEXT, c_double]),
    "get": (c_int, [POINTER, POINTER, TEXT, POINTER]),
    "get_text": (c_size_t, [POINTER, POINTER, TEXT, POINTER, c_size_t]),
    "new_table": (POINTER, [POINTER, POINTER, TEXT]),
    "get_column": (c_int, [POINTER, POINTER, TEXT, c_int, POINTER]),
    "get_grid": (c_int, [POINTER, POINTER, c_int, c_int] + [POINTER]*4),
    "get_stress_plane": (c_int, [POINTER, POINTER, c_int, c_int, POINTER, c_double, c_double, TEXT] + [POINTER]*2),
}


class Library:
    """Functions of wavycon.h by their names without 'wavycon_' and without their first argument."""

    def __init__(self, path):
        self.lib = CDLL(str(path))
        for name, (result, arguments) in FUNCTIONS.items():
            getattr(self.lib, "wavycon_" + name).restype = result
            getattr(self.lib, "wavycon_" + name).argtypes = arguments
        self.error = POINTER(self.lib.wavycon_new_error())

    def __getattr__(self, name):
        def call(*arguments):
            answer = getattr(self.lib, "wavycon_" + name)(self.error, *arguments)
            if self.lib.wavycon_get_code(self.error) != 0:
                message = create_string_buffer(self.lib.wavycon_get_message(self.error, None, 0))
                self.lib.wavycon_get_message(self.error, message, len(message))
                raise ValueError(message.value.decode())
            return POINTER(answer) if FUNCTIONS[name][0] == POINTER else answer
        return call

    def number(self, thing, name):
        value = c_double()
        self.get(thing, name.encode(), byref(value))
        return value.value

    def text(self, thing, name):
        text = create_string_buffer(self.get_text(thing, name.encode(), None, 0))
        self.get_text(thing, name.encode(), text, len(text))
        return text.value.decode()

    def table(self, solution, name):
        """The columns of a table, numbers and words."""
        table = self.new_table(solution, name.encode())
        rows, words, columns = int(self.number(table, "rows")), self.text(table, "words").splitlines(), {}
        for column in self.text(table, "columns").splitlines():
            values, (title, unit) = (c_double*rows)(), column.rstrip("]").split("[")
            self.get_column(table, title.encode(), rows, values)
            columns[title] = [words[int(value) - 1] for value in values] if unit == "word" else list(values)
        self.delete(table)
        return columns

    def delete(self, *handles):
        for handle in handles:
            self.lib.wavycon_delete(byref(handle))
