/* Arrays with the part of numpy's C interface that pybind11 calls, for a Python of Windows that has no numpy.

   An array holds numbers or truth values at an address, with any strides; it can be made of bytes and read as a buffer.
   The layouts of both objects and the places in the table are those that pybind11 writes down in pybind11/numpy.h: of
   numpy 1 for 3.11, as Blender 4.1 to 5.0 have it, and of numpy 2 for 3.13. */
#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { C_ORDER = 1, F_ORDER = 2, ALIGNED = 0x100, WRITEABLE = 0x400, TYPES = 13, DIMENSIONS = 8, TABLE = 300 };

#if PY_VERSION_HEX < 0x030C0000
enum { VERSION = 0x11 }; /* numpy 1.26 */
typedef int KindSize;
#else
enum { VERSION = 0x12 }; /* numpy 2.0 */
typedef Py_ssize_t KindSize;
#endif

typedef struct {
  PyObject_HEAD
  PyObject* typeobj;
  char kind, type, byteorder, former_flags;
  int number;
#if PY_VERSION_HEX >= 0x030C0000
  uint64_t flags;
#endif
  KindSize size, alignment;
} Kind;

typedef struct {
  PyObject_HEAD
  char* data;
  int nd;
  Py_ssize_t* shape; /* DIMENSIONS of them, then as many strides */
  Py_ssize_t* strides;
  PyObject* base;
  Kind* kind;
  int flags;
  bool owns;
} Array;

typedef struct {
  bool whole;
  bool is_unsigned;
  int64_t integer;
  double real;
} Number;

static PyTypeObject kind_type, array_type;
static PyObject* convert_sequence; /* given by Python: makes an array of anything that is none */
static Kind kinds[TYPES];
static const char letters[] = "?bBhHiIlLqQfd"; /* of the struct module, in the order of numpy's numbers */
static const int sizes[] = {1, 1, 1, 2, 2, 4, 4, 4, 4, 8, 8, 4, 8}; /* a long has 4 bytes in Windows */

static Number read_number(const char* at, char letter) {
  Number n = {true, false, 0, 0};
#define READ(letter, type) case letter: { type value; memcpy(&value, at, sizeof value); n.integer = (int64_t)value; break; }
  switch (letter) {
    READ('?', uint8_t) READ('b', int8_t) READ('B', uint8_t) READ('h', int16_t) READ('H', uint16_t) READ('i', int32_t)
    READ('I', uint32_t) READ('l', int32_t) READ('L', uint32_t) READ('q', int64_t)
    case 'Q': memcpy(&n.integer, at, 8); n.is_unsigned = true; break;
    case 'f': { float value; memcpy(&value, at, 4); n.real = value; n.whole = false; break; }
    default: memcpy(&n.real, at, 8); n.whole = false;
  }
  if (n.whole) n.real = n.is_unsigned ? (double)(uint64_t)n.integer : (double)n.integer;
  return n;
}

static void write_number(char* at, char letter, Number n) {
  const int64_t integer = n.whole ? n.integer : (int64_t)n.real;
#define WRITE(letter, type, from) case letter: { const type value = (type)(from); memcpy(at, &value, sizeof value); break; }
  switch (letter) {
    WRITE('?', uint8_t, n.real != 0)
    WRITE('b', int8_t, integer) WRITE('B', uint8_t, integer) WRITE('h', int16_t, integer) WRITE('H', uint16_t, integer)
    WRITE('i', int32_t, integer) WRITE('I', uint32_t, integer) WRITE('l', int32_t, integer)
    WRITE('L', uint32_t, integer) WRITE('q', int64_t, integer) WRITE('Q', int64_t, integer)
    WRITE('f', float, n.real)
    default: memcpy(at, &n.real, 8);
  }
}

static Py_ssize_t count(const Array* a) {
  Py_ssize_t product = 1;
  for (int k = 0; k < a->nd; ++k) product *= a->shape[k];
  return product;
}

static bool is_packed(const Array* a, bool fortran) {
  Py_ssize_t step = a->kind->size;
  for (int k = 0; k < a->nd; ++k) {
    const int axis = fortran ? k : a->nd - 1 - k;
    if (a->shape[axis] > 1 && a->strides[axis] != step) return false;
    step *= a->shape[axis];
  }
  return true;
}

static void set_flags(Array* a, int kept) {
  const bool empty = count(a) == 0;
  a->flags = ALIGNED | kept | (empty || is_packed(a, false) ? C_ORDER : 0) | (empty || is_packed(a, true) ? F_ORDER : 0);
}

static void pack(Array* a, bool fortran) {
  Py_ssize_t step = a->kind->size;
  for (int k = 0; k < a->nd; ++k) {
    const int axis = fortran ? k : a->nd - 1 - k;
    a->strides[axis] = step;
    step *= a->shape[axis];
  }
}

/* An array of memory at `data`, or of its own where that is null. */
static Array* make(Kind* kind, int nd, const Py_ssize_t* shape, const Py_ssize_t* strides, char* data, bool fortran) {
  if (nd > DIMENSIONS) return PyErr_SetString(PyExc_ValueError, "too many dimensions"), NULL;
  Array* a = PyObject_New(Array, &array_type);
  if (!a) return NULL;
  a->shape = calloc(2 * DIMENSIONS, sizeof *a->shape);
  a->strides = a->shape + DIMENSIONS;
  a->base = NULL;
  a->nd = nd;
  a->kind = (Kind*)Py_NewRef(kind);
  if (nd) memcpy(a->shape, shape, nd * sizeof *shape);
  if (strides) memcpy(a->strides, strides, nd * sizeof *strides);
  else pack(a, fortran);
  a->owns = !data;
  a->data = data ? data : calloc(count(a) + 1, kind->size);
  set_flags(a, WRITEABLE);
  return a;
}

static void free_array(PyObject* object) {
  Array* a = (Array*)object;
  if (a->owns) free(a->data);
  free(a->shape);
  Py_XDECREF(a->base);
  Py_DECREF(a->kind);
  PyObject_Free(a);
}

/* Copies numbers into an array of the same shape, or repeats them along dimensions of length 1, as numpy does. */
static int copy_into(PyObject* target, PyObject* source) {
  Array *t = (Array*)target, *s = (Array*)source;
  Py_ssize_t index[DIMENSIONS] = {0}, step[DIMENSIONS] = {0};
  for (int k = 1; k <= t->nd; ++k) {
    const Py_ssize_t length = k <= s->nd ? s->shape[s->nd - k] : 1;
    if (length != 1 && length != t->shape[t->nd - k]) return PyErr_SetString(PyExc_ValueError, "shapes differ"), -1;
    if (length != 1) step[t->nd - k] = s->strides[s->nd - k];
  }
  for (Py_ssize_t left = count(t); left > 0; --left) {
    char *to = t->data, *from = s->data;
    for (int k = 0; k < t->nd; ++k) to += index[k] * t->strides[k], from += index[k] * step[k];
    write_number(to, t->kind->type, read_number(from, s->kind->type));
    for (int k = t->nd - 1; k >= 0 && ++index[k] == t->shape[k]; --k) index[k] = 0;
  }
  return 0;
}

static PyObject* new_of_kind(PyTypeObject* type, PyObject* kind, int nd, const Py_ssize_t* shape,
                             const Py_ssize_t* strides, void* data, int flags, PyObject* object) {
  (void)type, (void)object;
  Array* a = make((Kind*)kind, nd, shape, strides, data, false);
  Py_DECREF(kind);
  if (a && data) set_flags(a, flags & WRITEABLE);
  return (PyObject*)a;
}

static Array* converted(Array* source, Kind* kind, bool fortran) {
  Array* a = make(kind, source->nd, source->shape, NULL, NULL, fortran);
  if (a && copy_into((PyObject*)a, (PyObject*)source)) Py_CLEAR(a);
  return a;
}

static PyObject* new_copy(PyObject* source, int order) {
  (void)order;
  Array* a = (Array*)source;
  return (PyObject*)converted(a, a->kind, !(a->flags & C_ORDER) && a->flags & F_ORDER);
}

static bool same_kind(PyObject* a, PyObject* b) {
  return ((Kind*)a)->kind == ((Kind*)b)->kind && ((Kind*)a)->size == ((Kind*)b)->size;
}

static PyObject* from_any(PyObject* object, PyObject* kind, int least, int most, int wanted, PyObject* context) {
  (void)least, (void)most, (void)context;
  PyObject* found = Py_IS_TYPE(object, &array_type) ? Py_NewRef(object) : PyObject_CallOneArg(convert_sequence, object);
  if (!found || !Py_IS_TYPE(found, &array_type)) {
    Py_XDECREF(kind);
    return found;
  }
  Array* a = (Array*)found;
  const int order = wanted & (C_ORDER | F_ORDER);
  const bool fits = (!kind || same_kind(kind, (PyObject*)a->kind)) && (a->flags & order) == order;
  if (!fits) {
    const bool fortran = order & F_ORDER || (!order && !(a->flags & C_ORDER) && a->flags & F_ORDER);
    found = (PyObject*)converted(a, kind ? (Kind*)kind : a->kind, fortran);
    Py_DECREF(a);
  }
  Py_XDECREF(kind);
  return found;
}

static PyObject* squeeze(PyObject* source) {
  Array* s = (Array*)source;
  Py_ssize_t shape[DIMENSIONS], strides[DIMENSIONS];
  int nd = 0;
  for (int k = 0; k < s->nd; ++k) {
    if (s->shape[k] == 1) continue;
    shape[nd] = s->shape[k];
    strides[nd++] = s->strides[k];
  }
  Array* a = make(s->kind, nd, shape, strides, s->data, false);
  if (a) a->base = Py_NewRef(source), set_flags(a, s->flags & WRITEABLE);
  return (PyObject*)a;
}

static int set_base(PyObject* array, PyObject* base) {
  ((Array*)array)->base = base;
  return 0;
}

static PyObject* kind_of_number(int number) {
  if (number < 0 || number >= TYPES) return PyErr_SetString(PyExc_TypeError, "not a type of numbers"), NULL;
  return Py_NewRef(&kinds[number]);
}

static unsigned version(void) { return VERSION; }

static PyObject* missing(void) {
  PyErr_SetString(PyExc_NotImplementedError, "this stand-in for numpy has no such function");
  return NULL;
}

static PyObject* kind_name(PyObject* object) {
  const Kind* kind = (Kind*)object;
  if (kind->kind == 'b') return PyUnicode_FromString("bool");
  const char* family = kind->kind == 'f' ? "float" : kind->kind == 'i' ? "int" : "uint";
  return PyUnicode_FromFormat("%s%d", family, (int)kind->size * 8);
}

static int give_buffer(PyObject* object, Py_buffer* view, int flags) {
  Array* a = (Array*)object;
  if (PyBuffer_FillInfo(view, object, a->data, count(a) * a->kind->size, !(a->flags & WRITEABLE), PyBUF_SIMPLE)) return -1;
  view->itemsize = a->kind->size;
  view->format = flags & PyBUF_FORMAT ? &a->kind->type : NULL; /* the byte order that follows ends the text */
  view->ndim = a->nd;
  view->shape = a->shape;
  view->strides = a->strides;
  return 0;
}

static PyObject* array_of(PyObject* module, PyObject* arguments) {
  (void)module;
  const char* bytes;
  const char* letter;
  PyObject* lengths;
  Py_ssize_t size, shape[DIMENSIONS];
  int fortran = 0, writeable = 1;
  if (!PyArg_ParseTuple(arguments, "y#sO!|pp", &bytes, &size, &letter, &PyTuple_Type, &lengths, &fortran, &writeable)) {
    return NULL;
  }
  const char* place = strchr(letters, *letter);
  const Py_ssize_t nd = PyTuple_Size(lengths);
  if (!place || nd > DIMENSIONS) return PyErr_SetString(PyExc_TypeError, "not an array of numbers"), NULL;
  for (Py_ssize_t k = 0; k < nd; ++k) shape[k] = PyLong_AsSsize_t(PyTuple_GetItem(lengths, k));
  Array* a = make(&kinds[place - letters], (int)nd, shape, NULL, NULL, fortran);
  if (!a) return NULL;
  memcpy(a->data, bytes, size < count(a) * a->kind->size ? size : count(a) * a->kind->size);
  set_flags(a, writeable ? WRITEABLE : 0);
  return (PyObject*)a;
}

static PyObject* set_conversion(PyObject* module, PyObject* function) {
  (void)module;
  Py_XSETREF(convert_sequence, Py_NewRef(function));
  Py_RETURN_NONE;
}

static PyObject* writeable(PyObject* array, void* data) {
  (void)data;
  return PyBool_FromLong(((Array*)array)->flags & WRITEABLE);
}

static PyBufferProcs buffers = {give_buffer, NULL};
static PyGetSetDef properties[] = {{"writeable", writeable, NULL, NULL, NULL}, {NULL}};
static PyTypeObject kind_type = {PyVarObject_HEAD_INIT(NULL, 0).tp_name = "numpy.dtype", .tp_basicsize = sizeof(Kind),
                                 .tp_flags = Py_TPFLAGS_DEFAULT, .tp_repr = kind_name, .tp_str = kind_name};
static PyTypeObject array_type = {PyVarObject_HEAD_INIT(NULL, 0).tp_name = "numpy.ndarray",
                                  .tp_basicsize = sizeof(Array), .tp_dealloc = free_array, .tp_as_buffer = &buffers,
                                  .tp_flags = Py_TPFLAGS_DEFAULT, .tp_getset = properties};
static PyTypeObject void_type = {PyVarObject_HEAD_INIT(NULL, 0).tp_name = "numpy.void",
                                 .tp_basicsize = sizeof(PyObject), .tp_flags = Py_TPFLAGS_DEFAULT};
static PyMethodDef functions[] = {
    {"array", array_of, METH_VARARGS, "array(bytes, letter of the type, shape, fortran=False, writeable=True)"},
    {"set_conversion", set_conversion, METH_O, "Sets the function that makes an array of any other object."},
    {NULL}};
static struct PyModuleDef definition = {PyModuleDef_HEAD_INIT, .m_name = "multiarray", .m_size = -1,
                                        .m_methods = functions};

static void** table(void) {
  static void* entries[TABLE];
  for (int k = 0; k < TABLE; ++k) entries[k] = (void*)missing;
  entries[2] = &array_type, entries[3] = &kind_type, entries[39] = &void_type;
  entries[45] = (void*)kind_of_number, entries[50] = (void*)copy_into, entries[69] = (void*)from_any;
  entries[85] = (void*)new_copy, entries[94] = (void*)new_of_kind, entries[136] = (void*)squeeze;
  entries[182] = (void*)same_kind, entries[211] = (void*)version, entries[282] = (void*)set_base;
  return entries;
}

PyMODINIT_FUNC PyInit_multiarray(void) {
  if (PyType_Ready(&kind_type) || PyType_Ready(&array_type) || PyType_Ready(&void_type)) return NULL;
  for (int k = 0; k < TYPES; ++k) {
    const char family = k == 0 ? 'b' : k > 10 ? 'f' : k % 2 ? 'i' : 'u';
    kinds[k] = (Kind){.ob_base = {.ob_refcnt = 1, .ob_type = &kind_type}, .kind = family, .type = letters[k],
                      .number = k, .size = sizes[k], .alignment = sizes[k]};
  }
  PyObject* module = PyModule_Create(&definition);
  if (!module || PyModule_AddObject(module, "_ARRAY_API", PyCapsule_New(table(), NULL, NULL))) return NULL;
  return PyModule_AddObjectRef(module, "ndarray", (PyObject*)&array_type) ? NULL : module;
}
