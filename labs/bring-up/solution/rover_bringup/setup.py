from setuptools import find_packages, setup

package_name = 'rover_bringup'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/launch', ['launch/bring_up.launch.py']),
        ('share/' + package_name + '/config', ['config/rovers.yaml']),
    ],
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='A learner',
    maintainer_email='learner@example.com',
    description='Two rovers, started with one command.',
    license='Apache-2.0',
    entry_points={
        'console_scripts': [
            'speed_limiter = rover_bringup.speed_limiter:main',
            'beacon = rover_bringup.beacon:main',
        ],
    },
)
