"""Wrong packages that are made by themselves, from a lab's solution: is each of them caught?"""
