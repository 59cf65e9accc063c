"""All compiled functions of the method. Plain arrays in and out; the functions that call them say what the arrays mean.

Every kernel is `@njit(nogil=True, cache=True)`, takes contiguous arrays and allocates little, so that a pool of threads
maps it over blocks of frames. Shapes are not checked here: the test hook that checks them would break compiled code.
"""
