"""What Jazzy's `launch`, `launch_ros`, `launch_xml` and `launch_yaml` have, by name.

With it a name that is right there and not carried out here is told from one that is misspelt.
From what the packages export: launch 3.4 and launch_ros 0.26.
"""

from __future__ import annotations

_EXPORTED = {
    "launch": """
        Action Condition Event EventHandler InvalidLaunchFileError LaunchContext LaunchDescription
        LaunchDescriptionEntity LaunchDescriptionSource LaunchIntrospector LaunchService
        SomeActionsType SomeActionsType_types_tuple SomeEntitiesType SomeEntitiesType_types_tuple
        SomeSubstitutionsType SomeSubstitutionsType_types_tuple Substitution
        """,
    "launch.actions": """
        AppendEnvironmentVariable DeclareLaunchArgument EmitEvent ExecuteLocal ExecuteProcess
        ForEach ForLoop GroupAction IncludeLaunchDescription Log LogDebug LogError LogInfo
        LogWarning OpaqueCoroutine OpaqueFunction PopEnvironment PopLaunchConfigurations
        PushEnvironment PushLaunchConfigurations RegisterEventHandler ReplaceEnvironmentVariables
        ResetEnvironment ResetLaunchConfigurations SetEnvironmentVariable SetLaunchConfiguration
        Shutdown TimerAction UnregisterEventHandler UnsetEnvironmentVariable
        UnsetLaunchConfiguration
        """,
    "launch.conditions": """
        IfCondition InvalidConditionExpressionError LaunchConfigurationEquals
        LaunchConfigurationNotEquals UnlessCondition evaluate_condition_expression
        """,
    "launch.descriptions": "Executable",
    "launch.event_handlers": """
        OnActionEventBase OnExecutionComplete OnIncludeLaunchDescription OnProcessExit OnProcessIO
        OnProcessStart OnShutdown event_named
        """,
    "launch.events": """
        ExecutionComplete IncludeLaunchDescription Shutdown TimerEvent matches_action
        """,
    "launch.events.process": """
        ProcessExited ProcessIO ProcessStarted ProcessStderr ProcessStdin ProcessStdout
        ProcessTargetedEvent RunningProcessEvent ShutdownProcess SignalProcess matches_action
        matches_executable matches_name matches_pid
        """,
    "launch.frontend": """
        Entity InvalidFrontendLaunchFileError Parser expose_action expose_substitution
        parse_if_substitutions
        """,
    "launch.launch_description_sources": """
        AnyLaunchDescriptionSource FrontendLaunchDescriptionSource InvalidFrontendLaunchFileError
        InvalidLaunchFileError InvalidPythonLaunchFileError PythonLaunchDescriptionSource
        get_launch_description_from_any_launch_file
        get_launch_description_from_frontend_launch_file
        get_launch_description_from_python_launch_file load_python_launch_file_as_module
        """,
    "launch.logging": """
        LaunchConfig get_log_file_path get_logger get_output_loggers launch_config
        log_handler_factory
        """,
    "launch.substitutions": """
        AllSubstitution AndSubstitution AnonName AnySubstitution Command EnvironmentVariable
        EqualsSubstitution FileContent FindExecutable ForEachVar ForLoopIndex IfElseSubstitution
        LaunchConfiguration LaunchLogDir LocalSubstitution NotEqualsSubstitution NotSubstitution
        OrSubstitution PathJoinSubstitution PathSubstitution PythonExpression
        StringJoinSubstitution SubstitutionFailure TextSubstitution ThisLaunchFile
        ThisLaunchFileDir
        """,
    "launch.utilities": """
        AsyncSafeSignalManager create_future ensure_argument_type is_a is_a_subclass
        isclassinstance normalize_to_list_of_entities normalize_to_list_of_substitutions
        perform_substitutions visit_all_entities_and_collect_futures
        """,
    "launch_ros": "",
    "launch_ros.actions": """
        ComposableNodeContainer LifecycleNode LifecycleTransition LoadComposableNodes Node
        PushROSNamespace PushRosNamespace ROSTimer RosTimer SetParameter SetParametersFromFile
        SetROSLogDir SetRemap SetUseSimTime
        """,
    "launch_ros.descriptions": """
        ComposableLifecycleNode ComposableNode Node NodeTrait Parameter ParameterFile
        ParameterValue RosExecutable
        """,
    "launch_ros.event_handlers": "OnStateTransition",
    "launch_ros.events": "matches_node_name",
    "launch_ros.events.lifecycle": """
        ChangeState StateTransition matches_node_name matches_transition
        """,
    "launch_ros.substitutions": """
        ExecutableInPackage FindPackage FindPackagePrefix FindPackageShare Parameter
        """,
    "launch_ros.utilities": """
        LifecycleEventManager add_node_name evaluate_parameters evaluate_parameters_dict
        get_node_name_count is_namespace_absolute is_root_namespace make_namespace_absolute
        normalize_parameters normalize_parameters_dict normalize_remap_rule normalize_remap_rules
        plugin_support prefix_namespace to_parameters_list
        """,
    "launch_xml": "Entity Parser",
    "launch_xml.launch_description_sources": """
        XMLLaunchDescriptionSource get_launch_description_from_xml_launch_file
        """,
    "launch_yaml": "Entity Parser",
    "launch_yaml.launch_description_sources": """
        YAMLLaunchDescriptionSource get_launch_description_from_yaml_launch_file
        """,
}
PACKAGES = tuple(_EXPORTED)
_APART = {
    "launch.action": "Action",
    "launch.actions.for_loop": "ForEach ForLoop",
    "launch.actions.log": "Log LogDebug LogError LogInfo LogWarning",
    "launch.actions.shutdown_action": "Shutdown",
    "launch.conditions.evaluate_condition_expression_impl": "evaluate_condition_expression",
    "launch.event_handler": "BaseEventHandler EventHandler",
    "launch.events.matchers": "matches_action",
    "launch.events.process.process_matchers": """
        matches_action matches_executable matches_name matches_pid
        """,
    "launch.frontend.expose": "expose_action expose_substitution",
    "launch.frontend.parse_substitution": "parse_if_substitutions parse_substitution",
    "launch.frontend.parser": "InvalidFrontendLaunchFileError Parser",
    "launch.frontend.type_utils": "",
    "launch.launch_description_sources.any_launch_file_utilities": """
        InvalidLaunchFileError get_launch_description_from_any_launch_file
        """,
    "launch.launch_description_sources.frontend_launch_file_utilities": """
        InvalidFrontendLaunchFileError get_launch_description_from_frontend_launch_file
        """,
    "launch.launch_description_sources.python_launch_file_utilities": """
        InvalidPythonLaunchFileError get_launch_description_from_python_launch_file
        load_python_launch_file_as_module
        """,
    "launch.logging.handlers": "",
    "launch.some_actions_type": "SomeActionsType SomeActionsType_types_tuple",
    "launch.some_entities_type": "SomeEntitiesType SomeEntitiesType_types_tuple",
    "launch.some_substitutions_type": "SomeSubstitutionsType SomeSubstitutionsType_types_tuple",
    "launch.substitutions.boolean_substitution": """
        AllSubstitution AndSubstitution AnySubstitution NotSubstitution OrSubstitution
        """,
    "launch.utilities.class_tools_impl": "is_a is_a_subclass isclassinstance",
    "launch.utilities.create_future_impl": "create_future",
    "launch.utilities.ensure_argument_type_impl": "ensure_argument_type",
    "launch.utilities.normalize_to_list_of_entities_impl": "normalize_to_list_of_entities",
    "launch.utilities.normalize_to_list_of_substitutions_impl": """
        normalize_to_list_of_substitutions
        """,
    "launch.utilities.perform_substitutions_impl": "perform_substitutions",
    "launch.utilities.signal_management": "AsyncSafeSignalManager",
    "launch.utilities.type_utils": """
        coerce_list coerce_to_type extract_type get_typed_value is_instance_of
        is_normalized_substitution is_substitution normalize_typed_substitution
        perform_typed_substitution
        """,
    "launch.utilities.typing_file_path": "FilePath",
    "launch.utilities.visit_all_entities_and_collect_futures_impl": """
        visit_all_entities_and_collect_futures
        """,
    "launch_ros.actions.ros_timer": "ROSTimer RosTimer",
    "launch_ros.default_launch_description": "ROSSpecificLaunchStartup",
    "launch_ros.event_handlers.on_state_transition": "OnStateTransition",
    "launch_ros.events.lifecycle.lifecycle_node_matchers": "matches_node_name matches_transition",
    "launch_ros.events.matchers": "matches_node_name",
    "launch_ros.parameter_descriptions": "Parameter ParameterFile ParameterValue",
    "launch_ros.parameters_type": "EvaluatedParameters Parameters ParametersDict SomeParameters",
    "launch_ros.remap_rule_type": "RemapRule RemapRules SomeRemapRule SomeRemapRules",
    "launch_ros.ros_adapters": "ROSAdapter get_ros_adapter get_ros_node",
    "launch_ros.substitutions.find_package": "FindPackage FindPackagePrefix FindPackageShare",
    "launch_ros.utilities.evaluate_parameters": "evaluate_parameters evaluate_parameters_dict",
    "launch_ros.utilities.lifecycle_event_manager": "LifecycleEventManager",
    "launch_ros.utilities.namespace_utils": """
        is_namespace_absolute is_root_namespace make_namespace_absolute prefix_namespace
        """,
    "launch_ros.utilities.normalize_parameters": """
        normalize_parameter_dict normalize_parameters normalize_parameters_dict
        """,
    "launch_ros.utilities.normalize_remap_rule": "normalize_remap_rule normalize_remap_rules",
    "launch_ros.utilities.plugin_support": "PluginNotFoundError",
    "launch_ros.utilities.to_parameters_list": "to_parameters_list",
    "launch_ros.utilities.track_node_names": "add_node_name get_node_name_count",
    "launch_xml.entity": "Entity",
    "launch_xml.parser": "Parser",
    "launch_yaml.entity": "Entity",
    "launch_yaml.parser": "Parser",
}
"""Modules that are not called as the one class in them, and the names in each."""

_ALONE = {
    "launch": """
        condition event invalid_launch_file_error launch_context launch_description
        launch_description_entity launch_description_source launch_introspector launch_service
        substitution
        """,
    "launch.actions": """
        append_environment_variable declare_launch_argument emit_event execute_local
        execute_process group_action include_launch_description log_info opaque_coroutine
        opaque_function pop_environment pop_launch_configurations push_environment
        push_launch_configurations register_event_handler replace_environment_variables
        reset_environment reset_launch_configurations set_environment_variable
        set_launch_configuration timer_action unregister_event_handler
        unset_environment_variable unset_launch_configuration
        """,
    "launch.conditions": """
        if_condition invalid_condition_expression_error launch_configuration_equals
        launch_configuration_not_equals unless_condition
        """,
    "launch.descriptions": "executable",
    "launch.event_handlers": """
        event_named on_action_event_base on_execution_complete on_include_launch_description
        on_process_exit on_process_io on_process_start on_shutdown
        """,
    "launch.events": "execution_complete include_launch_description shutdown timer_event",
    "launch.events.process": """
        process_exited process_io process_started process_stderr process_stdin process_stdout
        process_targeted_event running_process_event shutdown_process signal_process
        """,
    "launch.frontend": "entity",
    "launch.launch_description_sources": """
        any_launch_description_source frontend_launch_description_source
        python_launch_description_source
        """,
    "launch.substitutions": """
        anon_name command environment_variable equals_substitution file_content find_executable
        if_else_substitution launch_configuration launch_log_dir local_substitution
        not_equals_substitution path_join_substitution path_substitution python_expression
        string_join_substitution substitution_failure text_substitution this_launch_file
        this_launch_file_dir
        """,
    "launch_ros.actions": """
        composable_node_container lifecycle_node lifecycle_transition load_composable_nodes node
        push_ros_namespace set_parameter set_parameters_from_file set_remap set_ros_log_dir
        set_use_sim_time
        """,
    "launch_ros.descriptions": """
        composable_lifecycle_node composable_node node node_trait parameter_file ros_executable
        """,
    "launch_ros.events.lifecycle": "change_state state_transition",
    "launch_ros.substitutions": "executable_in_package parameter",
    "launch_xml.launch_description_sources": "xml_launch_description_source",
    "launch_yaml.launch_description_sources": "yaml_launch_description_source",
}
"""Modules that have one class, and are called as it is: `timer_action` has TimerAction."""


def _class_in(package: str, module: str) -> tuple[str, ...]:
    """The classes of `package` that `module` is called after, in capitals or not."""
    plain = module.replace("_", "")
    return tuple(n for n in _EXPORTED[package].split() if n.replace("_", "").lower() == plain)


MODULES: dict[str, tuple[str, ...]] = {
    **{module: tuple(names.split()) for module, names in (_EXPORTED | _APART).items()},
    **{
        f"{package}.{module}": _class_in(package, module)
        for package, modules in _ALONE.items()
        for module in modules.split()
    },
}
"""Every module of the four packages that a launch file can name, and the names in it."""

_OF_EVENT = "name"
_OF_PROCESS_EVENT = f"{_OF_EVENT} action cmd cwd env execute_process_action pid process_name"
ATTRIBUTES = {
    "Entity": """
        describe describe_conditional_sub_entities describe_sub_entities get_asyncio_future visit
        """,
    "Action": "condition execute get_sub_entities parse",
    "LaunchDescription": """
        add_action add_entity deprecated deprecated_reason entities get_launch_arguments
        get_launch_arguments_with_include_launch_description_actions
        """,
    "LaunchContext": """
        add_completion_future argv asyncio_loop emit_event emit_event_sync environment
        extend_globals extend_locals get_locals_as_dict is_shutdown launch_configurations locals
        noninteractive perform_substitution register_event_handler unregister_event_handler
        would_handle_event
        """,
    "AnyLaunchDescriptionSource": """
        get_launch_description location method try_get_launch_description_without_context
        """,
    "Substitution": "describe parse perform",
    "Condition": "evaluate",
    "EventHandler": """
        describe entities handle handle_once handler_description matcher_description matches
        """,
    "DeclareLaunchArgument": "choices default_value description name",
    "SetLaunchConfiguration": "name value",
    "SetEnvironmentVariable": "name value",
    "AppendEnvironmentVariable": "name prepend separator value",
    "UnsetEnvironmentVariable": "name",
    "UnsetLaunchConfiguration": "name",
    "IncludeLaunchDescription": "launch_arguments launch_description_source",
    "LogInfo": "level logger_name msg",
    "TimerAction": "actions cancel cancel_on_shutdown handle is_waiting period reset type_name",
    "RegisterEventHandler": "event_handler",
    "UnregisterEventHandler": "event_handler",
    "EmitEvent": "event",
    "ExecuteProcess": """
        additional_env cached_output cmd cwd emulate_tty env get_stderr get_stdout log_cmd name
        output output_format prefix prepare process_description process_details return_code shell
        sigkill_timeout sigterm_timeout
        """,
    "Node": """
        expanded_node_namespace expanded_remapping_rules is_node_name_fully_specified
        node_executable node_name node_package parse_nested_parameters ros_exec
        """,
    "PushRosNamespace": "namespace",
    "SetParameter": "name value",
    "SetParametersFromFile": "filename",
    "SetRemap": "dst src",
    "LaunchConfiguration": "variable_name",
    "EnvironmentVariable": "default_value name",
    "TextSubstitution": "text",
    "FindExecutable": "name",
    "FindPackagePrefix": "find package",
    "ExecutableInPackage": "executable package",
    "PathJoinSubstitution": "substitutions",
    "PythonExpression": "expression python_modules",
    "LocalSubstitution": "expression",
    "Command": "command on_stderr",
    "EqualsSubstitution": "left right",
    "NotEqualsSubstitution": "left right",
    "AndSubstitution": "left right",
    "OrSubstitution": "left right",
    "NotSubstitution": "value",
    "IfElseSubstitution": "condition else_value if_value",
    "AnonName": "name",
    "FileContent": "path",
    "ParameterValue": "evaluate value value_type",
    "Parameter": "description evaluate name value value_type",
    "ParameterFile": "allow_substs cleanup evaluate param_file",
    "Event": _OF_EVENT,
    "Shutdown": f"{_OF_EVENT} due_to_sigint reason",
    "ProcessStarted": _OF_PROCESS_EVENT,
    "ProcessExited": f"{_OF_PROCESS_EVENT} returncode",
    "ProcessIO": f"{_OF_PROCESS_EVENT} fd from_stderr from_stdin from_stdout text",
    "ExecutionComplete": f"{_OF_EVENT} action",
}
"""A class of ours to the attributes and methods that Jazzy's class has."""


def has(module: str, name: str) -> bool:
    """Whether Jazzy's `module` has `name`: a class, a function, or a module inside."""
    return f"{module}.{name}" in MODULES or name in MODULES.get(module, ())


def has_attribute(cls: type, name: str | None) -> bool:
    """Whether Jazzy's class of this name, or one of those that it is made from, has `name`."""
    return any(name in ATTRIBUTES.get(base.__name__, "").split() for base in cls.__mro__)
