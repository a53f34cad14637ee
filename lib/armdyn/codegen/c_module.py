"""Writes the C source that makes `c_code.source` a Python module, with the C API of Python and NumPy."""


def source(program_source: str, suspect: float) -> str:
    """The whole module; every function of it takes the constants k, a float64 array, first.

    `one(k, q, v, u)`: q̈, an array, or None where q, v, u are not plain (n,) float64 arrays, or
    the smallest pivot of M is below `suspect` of its trace, or q̈ is not finite: the caller then
    looks closer. `of_floats(k, other, q1, …, u_n)`: a tuple, or what `other(q1, …, u_n)` gives there.
    `many(k, q, v, u, out)`: rows (N, n), or (1, n) for the same row throughout; False there.
    `rk4(k, least, x0, u, dt, steps, keep, out)`: what `rk4` of `c_code.source` returns.
    """
    return _MODULE.replace("@SUSPECT@", repr(suspect)).replace("@PROGRAM@", program_source)


_MODULE = """#define PY_SSIZE_T_CLEAN
#define NPY_NO_DEPRECATED_API NPY_1_7_API_VERSION
#include <Python.h>
#include <numpy/arrayobject.h>

@PROGRAM@
#define DATA(object) ((double *)PyArray_DATA((PyArrayObject *)(object)))

static int is_vector(PyObject *object)
{
    PyArrayObject *array = (PyArrayObject *)object;
    return PyArray_CheckExact(object) && PyArray_NDIM(array) == 1 && PyArray_DIM(array, 0) == N
           && PyArray_TYPE(array) == NPY_DOUBLE && PyArray_ISCARRAY_RO(array);
}

static PyObject *py_one(PyObject *self, PyObject *const *args, Py_ssize_t count)
{
    npy_intp size = N;
    if (count != 4) {
        PyErr_SetString(PyExc_TypeError, "one: needs k, q, v, u");
        return NULL;
    }
    if (!is_vector(args[1]) || !is_vector(args[2]) || !is_vector(args[3]))
        Py_RETURN_NONE;
    PyObject *found = PyArray_SimpleNew(1, &size, NPY_DOUBLE);
    if (found == NULL)
        return NULL;
    if (one(DATA(args[0]), @SUSPECT@, DATA(args[1]), DATA(args[2]), DATA(args[3]), DATA(found)))
        return found;
    Py_DECREF(found);
    Py_RETURN_NONE;
}

static PyObject *py_of_floats(PyObject *self, PyObject *const *args, Py_ssize_t count)
{
    double state[3 * N], a[N];
    if (count != 2 + 3 * N)
        return PyErr_Format(PyExc_TypeError,
                            "dynamics_floats: got %zd numbers, needs %d: %d each of q, qd and u",
                            count - 2, 3 * N, N);
    for (int i = 0; i < 3 * N; i++) {
        state[i] = PyFloat_AsDouble(args[i + 2]);
        if (state[i] == -1.0 && PyErr_Occurred())
            return NULL;
    }
    if (!one(DATA(args[0]), @SUSPECT@, state, state + N, state + 2 * N, a))
        return PyObject_Vectorcall(args[1], args + 2, 3 * N, NULL);
    PyObject *found = PyTuple_New(N);
    for (int i = 0; found != NULL && i < N; i++) {
        PyObject *number = PyFloat_FromDouble(a[i]);
        if (number == NULL)
            Py_CLEAR(found);
        else
            PyTuple_SET_ITEM(found, i, number);
    }
    return found;
}

static ptrdiff_t step_of(PyObject *rows, npy_intp width)
{
    return PyArray_DIM((PyArrayObject *)rows, 0) == 1 ? 0 : (ptrdiff_t)width;
}

static PyObject *py_many(PyObject *self, PyObject *args)
{
    PyArrayObject *k, *q, *v, *u, *out;
    if (!PyArg_ParseTuple(args, "O!O!O!O!O!", &PyArray_Type, &k, &PyArray_Type, &q,
                          &PyArray_Type, &v, &PyArray_Type, &u, &PyArray_Type, &out))
        return NULL;
    ptrdiff_t suspect;
    Py_BEGIN_ALLOW_THREADS
    suspect = many(DATA(k), @SUSPECT@, PyArray_DIM(out, 0), DATA(q), step_of((PyObject *)q, N),
                   DATA(v), step_of((PyObject *)v, N), DATA(u), step_of((PyObject *)u, N),
                   DATA(out));
    Py_END_ALLOW_THREADS
    return PyBool_FromLong(suspect < 0);
}

static PyObject *py_rk4(PyObject *self, PyObject *args)
{
    PyArrayObject *k, *x0, *u, *out;
    double least, dt;
    Py_ssize_t steps;
    int keep;
    if (!PyArg_ParseTuple(args, "O!dO!O!dnpO!", &PyArray_Type, &k, &least, &PyArray_Type, &x0,
                          &PyArray_Type, &u, &dt, &steps, &keep, &PyArray_Type, &out))
        return NULL;
    ptrdiff_t stopped;
    Py_BEGIN_ALLOW_THREADS
    stopped = rk4(DATA(k), least, PyArray_DIM(out, 0), DATA(x0), step_of((PyObject *)x0, 2 * N),
                  DATA(u), step_of((PyObject *)u, N), dt, steps, keep, DATA(out));
    Py_END_ALLOW_THREADS
    return PyLong_FromSsize_t(stopped);
}

static PyMethodDef functions[] = {
    {"one", (PyCFunction)(void (*)(void))py_one, METH_FASTCALL, NULL},
    {"of_floats", (PyCFunction)(void (*)(void))py_of_floats, METH_FASTCALL, NULL},
    {"many", py_many, METH_VARARGS, NULL},
    {"rk4", py_rk4, METH_VARARGS, NULL},
    {NULL, NULL, 0, NULL},
};

static struct PyModuleDef module = {PyModuleDef_HEAD_INIT, "armdyn_compiled", NULL, -1, functions};

PyMODINIT_FUNC PyInit_armdyn_compiled(void)
{
    import_array();
    return PyModule_Create(&module);
}
"""
