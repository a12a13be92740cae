"""The student's colcon workspace: which package is meant, what stands in it, a copy to build.

Knows files; knows no points and no ROS graph. What a student can mend is raised as a
`errors.WorkspaceError`: one small type each, whose text says what is and what to do next.
"""
