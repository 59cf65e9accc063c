"""The codec of attributes: any elements, byte by byte."""
