"""The program of `tf2_tools`, under the name that it has there."""
