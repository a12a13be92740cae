from setuptools import find_packages, setup

package_name = 'frames'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='A learner',
    maintainer_email='learner@example.com',
    description='The frames of a rover, its walls, and a map of them.',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'frames = frames.frames:main',
        ],
    },
)
