/* Put before each C file when the course's message types are built for every Python
 * (built_interfaces.py). With Py_LIMITED_API, Python.h declares the stable ABI alone, which Python
 * 3.10 and every later one has. The generated code uses these macros of one version's ABI; each
 * becomes the function of the stable one that does the same. */
#define Py_LIMITED_API 0x030a0000
#include <Python.h>

#define PyBytes_AS_STRING(bytes) PyBytes_AsString(bytes)
#define PyFloat_AS_DOUBLE(number) PyFloat_AsDouble(number)
#define PyList_SET_ITEM(list, index, item) PyList_SetItem((list), (index), (item))
#define PySequence_Fast_GET_SIZE(sequence) PySequence_Size(sequence)
/* The reference is borrowed, as that of the macro: PySequence_Fast has made a list or a tuple. */
#define PySequence_Fast_GET_ITEM(sequence, index) \
  (PyList_Check(sequence) ? PyList_GetItem((sequence), (index)) \
                          : PyTuple_GetItem((sequence), (index)))
/* Asked for texts only after PyUnicode_AsUTF8String has said that they are such. */
#define PyUnicode_1BYTE_DATA(text) PyUnicode_AsUTF8AndSize((text), NULL)
